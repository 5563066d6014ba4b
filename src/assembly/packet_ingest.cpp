// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <cmath>
#include <numbers>

namespace pago {

namespace {

/// A silence that outlasts the rotation tracker's memory.
constexpr std::int64_t kSilence_ns = 50'000'000;

}  // namespace

PacketIngest::PacketIngest(const AssemblyConfig& assembly,
                           const Hdl64Config& sensor,
                           const hdl64::Calibration& calibration,
                           SweepExchange& exchange,
                           const SelfFilter& self)
    : sequencer_(assembly.reorder_window),
      decoder_(calibration, sensor.min_range_m, sensor.max_range_m),
      assembler_(assembly, calibration, exchange),
      stamp_to_first_firing_ns_(sensor.packet_stamp == PacketStamp::kLastFiring ? -hdl64::kPacketPeriod_ns
                                                                                : 0),
      held_(kHold),
      held_azimuths_(kHold),
      self_(self) {}

void PacketIngest::push(const Datagram& datagram) noexcept {
  ++packets_.received;
  if (!is_identified_) identify(datagram);
  if (is_refused_) return count_bad(PacketFault::kOtherSensor);
  PacketFault fault = hdl64::check_packet(datagram.payload);
  if (fault == PacketFault::kNone) {
    const std::span bytes = datagram.payload.first<hdl64::kPacketBytes>();
    const auto stamp = clock_.read(hdl64::PacketView(bytes).stamp_us(), datagram.arrival_ns);
    if (stamp.verdict == hdl64::DeviceClock::Verdict::kRestarted) restart_clock();
    if (stamp.verdict != hdl64::DeviceClock::Verdict::kImplausible)
      return sequence({bytes, stamp.time_ns + stamp_to_first_firing_ns_, datagram.arrival_ns});
    fault = PacketFault::kStamp;
  }
  count_bad(fault);
  assembler_.note_bad_packet();
}

void PacketIngest::note_silence() noexcept {
  if (!is_identified_) return;
  while (const auto packet = sequencer_.take_regardless()) accept(*packet);
  break_off();
}

void PacketIngest::probe_again() noexcept {
  if (!is_refused_) return;
  is_refused_ = false;
  probe_ = {};
}

void PacketIngest::finish() noexcept {
  if (!is_identified_) return refuse();
  note_silence();
}

void PacketIngest::break_off() noexcept {
  release_held();
  assembler_.finish();
}

void PacketIngest::refuse() noexcept {
  is_refused_ = true;
  packets_.bad[static_cast<std::size_t>(PacketFault::kOtherSensor)] += sequencer_.forget() + num_held_;
  num_held_ = 0;
}

std::string PacketIngest::refusal() const {
  if (!is_refused_) return {};
  if (probe_.decided()) return hdl64::refusal(probe_.kind());
  const std::uint64_t came = packets_.received - packets_.bad[static_cast<std::size_t>(PacketFault::kSize)];
  return "the stream ended after " + std::to_string(came) + " packets of " +
         std::to_string(hdl64::kPacketBytes) + " bytes; its sensor is recognised by " +
         std::to_string(hdl64::StreamProbe::kPackets);
}

PacketCounters PacketIngest::packets() const noexcept {
  PacketCounters result = packets_;
  result.reordered = sequencer_.reordered();
  result.pending = sequencer_.held() + num_held_;
  return result;
}

void PacketIngest::identify(const Datagram& datagram) noexcept {
  if (is_refused_) return;
  probe_.add(datagram.payload, datagram.arrival_ns);
  if (!probe_.decided()) return;
  is_identified_ = hdl64::is_supported(probe_.kind());
  if (!is_identified_) refuse();
}

// What is still held belongs to the old count of time.
void PacketIngest::restart_clock() noexcept {
  while (const auto packet = sequencer_.take_regardless()) accept(*packet);
  if (is_identified_) {
    break_off();
  } else {
    // Nothing is decoded yet, so the odd ones out are those before.
    packets_.bad[static_cast<std::size_t>(PacketFault::kStamp)] += num_held_;
    num_held_ = 0;
  }
  sequencer_.restart();
  is_holding_ = true;
  is_same_clock_ = false;
}

void PacketIngest::sequence(const StampedPacket& packet) noexcept {
  switch (sequencer_.offer(packet)) {
    case PacketSequencer::Verdict::kNext:
      accept(packet);
      break;
    case PacketSequencer::Verdict::kHeld:
      break;
    case PacketSequencer::Verdict::kDuplicate:
      ++packets_.duplicate;
      return;
    case PacketSequencer::Verdict::kLate:
      ++packets_.late;
      return;
  }
  while (const auto held = sequencer_.take()) accept(*held);
}

void PacketIngest::accept(const StampedPacket& packet) noexcept {
  const std::int64_t silence_ns = packet.time_ns - newest_ns_;
  newest_ns_ = packet.time_ns;
  if (silence_ns > kSilence_ns && is_identified_) {
    release_held();
    if (silence_ns > kBrokenOff_ns) break_off();
    is_holding_ = true;
  }
  if (!is_holding_) is_holding_ = !tracker_.add(hdl64::PacketAzimuths::of(packet.view(), packet.time_ns));
  if (is_holding_)
    hold(packet);
  else
    assemble(packet);
}

void PacketIngest::hold(const StampedPacket& packet) noexcept {
  held_[num_held_].take(packet);
  held_azimuths_[num_held_] = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns);
  ++num_held_;
  if (num_held_ == kHold) release_held();
}

void PacketIngest::release_held() noexcept {
  if (num_held_ == 0) return;
  const bool continues = tracker_.prime(std::span(held_azimuths_).first(num_held_), is_same_clock_);
  if (!continues) assembler_.interrupt();
  is_holding_ = false;
  is_same_clock_ = true;
  for (std::size_t i = 0; i < num_held_; ++i) assemble(held_[i].packet());
  num_held_ = 0;
}

void PacketIngest::assemble(const StampedPacket& packet) noexcept {
  ++packets_.decoded;
  if (!tracker_.is_spinning()) return assembler_.interrupt();
  const double rate_rev_s = tracker_.rate_rev_s();
  for (int i = 0; i < hdl64::kFirings; ++i) {
    const std::int64_t time_ns = packet.time_ns + i * hdl64::kFiringPeriod_ns;
    const double revolutions = tracker_.revolutions(time_ns);
    const double azimuth_rad = 2.0 * std::numbers::pi * (revolutions - std::floor(revolutions));
    decoder_.decode(packet.view(), i, {azimuth_rad, 2.0 * std::numbers::pi * rate_rev_s}, returns_);
    if (self_.has_box()) self_hits_ += static_cast<std::uint64_t>(self_.remove_own(returns_));
    assembler_.add({time_ns, packet.arrival_ns, revolutions, rate_rev_s}, returns_);
  }
}

}  // namespace pago
