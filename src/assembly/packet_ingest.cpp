// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <cmath>
#include <numbers>

#include "pago/hdl64/block_times.hpp"

namespace pago {

namespace {

/// A silence that outlasts the rotation tracker's memory.
constexpr std::int64_t kSilence_ns = 50'000'000;

}  // namespace

PacketIngest::PacketIngest(const AssemblyConfig& assembly,
                           const Hdl64Config& sensor,
                           const hdl64::Calibration& calibration,
                           SweepExchange& exchange)
    : sequencer_(assembly.reorder_window),
      decoder_(calibration, sensor.min_range_m, sensor.max_range_m),
      assembler_(assembly, calibration, exchange),
      stamp_names_(sensor.packet_stamp),
      unidentified_(hdl64::StreamProbe::kMaxPackets),
      held_(kHold),
      held_azimuths_(kHold) {}

void PacketIngest::push(const Datagram& datagram) noexcept {
  if (is_refused_) return;
  ++packets_.received;
  const bool is_packet = datagram.payload.size() == hdl64::kPacketBytes;
  if (!is_packet) refuse(PacketFault::kSize);
  if (!is_identified_)
    identify(datagram);
  else if (is_packet)
    take(datagram.payload.first<hdl64::kPacketBytes>(), datagram.arrival_ns);
}

void PacketIngest::finish() noexcept {
  if (!is_identified_) is_refused_ = true;
  if (is_refused_) return;
  while (const auto packet = sequencer_.take_regardless()) accept(*packet);
  release_held();
  assembler_.finish();
}

std::string PacketIngest::refusal() const {
  if (!is_refused_) return {};
  if (probe_.decided()) return hdl64::refusal(probe_.kind());
  return "the stream ended after " + std::to_string(num_unidentified_) + " packets of " +
         std::to_string(hdl64::kPacketBytes) + " bytes; its sensor is recognised by " +
         std::to_string(hdl64::StreamProbe::kPackets);
}

PacketCounters PacketIngest::packets() const noexcept {
  PacketCounters result = packets_;
  result.reordered = sequencer_.reordered();
  result.pending = num_unidentified_ + sequencer_.held() + num_held_;
  return result;
}

// Until the sensor is known nobody can tell what is wrong with a packet: all wait.
void PacketIngest::identify(const Datagram& datagram) noexcept {
  probe_.add(datagram.payload, datagram.arrival_ns);
  if (datagram.payload.size() == hdl64::kPacketBytes)
    unidentified_[num_unidentified_++].take(
        {datagram.payload.first<hdl64::kPacketBytes>(), 0, datagram.arrival_ns});
  if (!probe_.decided()) return;
  is_identified_ = hdl64::is_supported(probe_.kind());
  is_refused_ = !is_identified_;
  if (is_refused_) return;
  set_format(hdl64::format_of(probe_.kind(), probe_.packet_period_ns()));
  for (std::size_t i = 0, n = std::exchange(num_unidentified_, 0); i < n; ++i)
    take(unidentified_[i].bytes, unidentified_[i].arrival_ns);
}

void PacketIngest::set_format(const hdl64::StreamFormat& format) noexcept {
  const auto times = hdl64::AzimuthTimes::of(format, format.block_times_ns());
  format_ = format;
  arrival_clock_.set_format(format, times);
  sequencer_.set_format(format);
  tracker_.set_times(times);
  decoder_.set_format(format);
  assembler_.set_format(format);
}

void PacketIngest::take(Bytes bytes, std::int64_t arrival_ns) noexcept {
  if (const PacketFault fault = hdl64::check_packet(bytes, format_); fault != PacketFault::kNone)
    return refuse(fault);
  const auto stamp = read_clock(bytes, arrival_ns);
  if (stamp.verdict == hdl64::DeviceClock::Verdict::kImplausible) return refuse(PacketFault::kStamp);
  if (stamp.verdict == hdl64::DeviceClock::Verdict::kRestarted) restart_clock();
  sequence({bytes, stamp.time_ns, arrival_ns});
}

/// Sensor time of a packet's first firing.
hdl64::DeviceClock::Reading PacketIngest::read_clock(Bytes bytes, std::int64_t arrival_ns) noexcept {
  const hdl64::PacketView packet(bytes);
  if (!format_.has_stamps()) {
    const auto azimuths = hdl64::PacketAzimuths::of(packet, 0, format_);
    return {hdl64::DeviceClock::Verdict::kFits, arrival_clock_.read(azimuths, arrival_ns)};
  }
  auto reading = clock_.read(packet.stamp_us(), arrival_ns);
  if (stamp_names_ == PacketStamp::kLastFiring) reading.time_ns -= format_.packet_period_ns();
  return reading;
}

void PacketIngest::refuse(PacketFault fault) noexcept {
  ++packets_.bad[static_cast<std::size_t>(fault)];
  assembler_.note_bad_packet();
}

// What is still held belongs to the old count of time.
void PacketIngest::restart_clock() noexcept {
  while (const auto packet = sequencer_.take_regardless()) accept(*packet);
  release_held();
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
  const bool after_silence = packet.time_ns - newest_ns_ > kSilence_ns;
  newest_ns_ = packet.time_ns;
  if (after_silence) {
    release_held();
    is_holding_ = true;
  }
  const auto azimuths = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns, format_);
  if (!is_holding_) is_holding_ = !tracker_.add(azimuths);
  if (is_holding_)
    hold(packet);
  else
    assemble(packet);
}

void PacketIngest::hold(const StampedPacket& packet) noexcept {
  held_[num_held_].take(packet);
  held_azimuths_[num_held_] = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns, format_);
  ++num_held_;
  if (num_held_ == kHold) release_held();
}

void PacketIngest::release_held() noexcept {
  if (num_held_ == 0) return;
  if (format_.kind == hdl64::SensorKind::kHdl64S1) measure_times();
  const bool continues = tracker_.prime(std::span(held_azimuths_).first(num_held_), is_same_clock_);
  if (!continues) assembler_.interrupt();
  is_holding_ = false;
  is_same_clock_ = true;
  for (std::size_t i = 0; i < num_held_; ++i) assemble(held_[i].packet());
  num_held_ = 0;
}

void PacketIngest::measure_times() noexcept {
  const auto times =
      hdl64::measure_block_times(std::span(held_azimuths_).first(num_held_), format_.packet_period_ns());
  if (!times) return;
  const hdl64::PacketLayout& layout = format_.layout(held_[0].packet().view());
  tracker_.set_times(hdl64::AzimuthTimes::of(format_, *times));
  decoder_.set_block_times(*times, hdl64::lower_delay_ns(layout, *times));
}

void PacketIngest::assemble(const StampedPacket& packet) noexcept {
  ++packets_.decoded;
  if (!tracker_.is_spinning()) return assembler_.interrupt();
  const double rate_rev_s = tracker_.rate_rev_s();
  const double start_rev = tracker_.revolutions(packet.time_ns);
  const double azimuth_rad = 2.0 * std::numbers::pi * (start_rev - std::floor(start_rev));
  decoder_.decode(packet.view(), {azimuth_rad, 2.0 * std::numbers::pi * rate_rev_s}, returns_);
  for (int i = 0; i < format_.firings(); ++i) {
    const std::int64_t after_ns = i * format_.firing_period_ns;
    const Firing firing{.time_ns = packet.time_ns + after_ns,
                        .arrival_ns = packet.arrival_ns,
                        .revolutions = start_rev + rate_rev_s * 1e-9 * static_cast<double>(after_ns),
                        .rate_rev_s = rate_rev_s};
    const auto index = static_cast<std::size_t>(i);
    assembler_.add(firing, returns_.strongest[index], format_.is_dual() ? &returns_.others[index] : nullptr);
  }
}

}  // namespace pago
