// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pago/core/prefetch.hpp"

namespace pago {

namespace {

/// A silence that outlasts the rotation tracker's memory.
constexpr std::int64_t kSilence_ns = 50'000'000;
/// Times of arrival beyond these (before 1970, after 2116) are damaged; sums with them must not overflow.
constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

double encoder_rev(std::uint16_t azimuth_cdeg) noexcept {
  return azimuth_cdeg / static_cast<double>(hdl64::kAzimuthSteps);
}

}  // namespace

PacketIngest::PacketIngest(const AssemblyConfig& assembly,
                           const Hdl64Config& sensor,
                           const hdl64::Calibration& calibration,
                           SweepExchange& exchange,
                           const SelfFilter& self)
    : sequencer_(assembly.reorder_window),
      decoder_(calibration, sensor.min_range_m, sensor.max_range_m),
      assembler_(assembly, calibration, exchange),
      stamp_names_(sensor.packet_stamp),
      cut_rev_(assembly.cut_azimuth_deg / 360.0),
      unidentified_(hdl64::StreamProbe::kMaxPackets),
      lasers_(calibration.lasers),
      power_level_(calibration.power_level),
      held_(kHold),
      held_azimuths_(kHold),
      self_(self) {}

void PacketIngest::push(const Datagram& datagram) noexcept {
  ++packets_.received;
  if (is_refused_) return count_bad(PacketFault::kOtherSensor);
  if (datagram.payload.size() != hdl64::kPacketBytes) {
    return refuse(PacketFault::kSize);
  }
  prefetch_to_read(datagram.payload);
  if (is_foreign(datagram)) {
    ++packets_.filtered;
    return;
  }
  if (!is_identified_) return identify(datagram);
  watch(datagram);
  take(datagram.payload.first<hdl64::kPacketBytes>(), datagram.arrival_ns);
}

void PacketIngest::note_silence() noexcept {
  use_all_held();
  assembler_.finish();
}

void PacketIngest::probe_again() noexcept {
  if (!is_refused_) return;
  is_refused_ = false;
  probe_ = {};
}

void PacketIngest::finish() noexcept {
  if (!is_identified_) return refuse_stream();
  note_silence();
}

void PacketIngest::break_off() noexcept {
  release_held();
  assembler_.finish();
}

void PacketIngest::refuse_stream() noexcept {
  is_refused_ = packets_.decoded == 0;
  packets_.bad[static_cast<std::size_t>(PacketFault::kOtherSensor)] += std::exchange(num_unidentified_, 0);
}

std::string PacketIngest::refusal() const {
  if (!is_refused_) return {};
  if (probe_.decided()) return hdl64::refusal(probe_.kind());
  const std::uint64_t came = packets_.bad[static_cast<std::size_t>(PacketFault::kOtherSensor)];
  return "the stream ended after " + std::to_string(came) + " packets of " +
         std::to_string(hdl64::kPacketBytes) + " bytes; its sensor is recognised by " +
         std::to_string(hdl64::StreamProbe::kPackets);
}

PacketCounters PacketIngest::packets() const noexcept {
  PacketCounters result = packets_;
  result.reordered = sequencer_.reordered();
  result.pending = num_unidentified_ + sequencer_.held() + num_held_;
  return result;
}

void PacketIngest::take(Bytes bytes, std::int64_t arrival_ns) noexcept {
  if (const PacketFault fault = hdl64::check_packet(bytes, format_); fault != PacketFault::kNone)
    return refuse(fault);
  arrival_ns = std::clamp<std::int64_t>(arrival_ns, 0, kLatest_ns);
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
  count_bad(fault);
  assembler_.note_bad_packet();
}

void PacketIngest::use_all_held() noexcept {
  while (const auto packet = sequencer_.take_regardless()) accept(*packet);
  release_held();
}

// What is still held belongs to the old count of time.
void PacketIngest::restart_clock() noexcept {
  note_silence();
  sequencer_.restart();
  clock_offset_.restart();
  status_.lose_place();
  blind_sector_.forget();
  had_gps_ = false;
  is_holding_ = true;
  hold_ = kHold;
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
  const bool after_silence = silence_ns > kSilence_ns;
  newest_ns_ = packet.time_ns;
  if (after_silence) release_held();
  if (silence_ns > kBrokenOff_ns) break_off();
  const bool is_after_blind = note_gap(packet);
  if (after_silence) {
    is_holding_ = true;
    hold_ = is_after_blind ? kShortHold : kHold;
  }
  read_status(packet, is_after_blind ? 1 : sequencer_.periods_on());
  clock_offset_.add(packet.time_ns + format_.packet_period_ns(), packet.arrival_ns);
  assembler_.set_clock_offset(clock_offset_at(packet.time_ns));

  const auto azimuths = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns, format_);
  if (!is_holding_ && !tracker_.add(azimuths)) {
    is_holding_ = true;
    hold_ = kHold;
  }
  if (is_holding_)
    hold(packet, is_after_blind);
  else
    assemble(packet, is_after_blind);
}

/// Looks at what is missing before a packet. True if it is what the sensor never sends.
bool PacketIngest::note_gap(const StampedPacket& packet) noexcept {
  const std::int64_t missing = sequencer_.periods_on() - 1;
  const double azimuth_rev = encoder_rev(packet.view().block_azimuth_cdeg(0));
  const double from_rev = newest_end_rev_;
  const double turn_rev = tracker_.rate_rev_s() * 1e-9 * static_cast<double>(format_.packet_period_ns());
  newest_end_rev_ = azimuth_rev + turn_rev - std::floor(azimuth_rev + turn_rev);
  if (missing == 0 || !tracker_.is_spinning()) {
    blind_sector_.note_packet(azimuth_rev);
    return false;
  }
  const double turned_rev = turn_rev * static_cast<double>(missing);
  const double beyond = turned_rev - (azimuth_rev - from_rev);
  const double to_rev = azimuth_rev + std::nearbyint(beyond);
  const auto firings = static_cast<std::uint64_t>(missing * format_.firings());
  const std::uint64_t blind = blind_sector_.note_gap(from_rev, to_rev, firings);
  sequencer_.excuse(blind);
  return blind > 0;
}

void PacketIngest::read_status(const StampedPacket& packet, std::int64_t packets_on) noexcept {
  if (!format_.has_stamps()) return;
  const std::uint32_t readings = status_.readings();
  status_.add(packet.view().status_type(), packet.view().status_value(), packets_on);
  const hdl64::SensorStatus& status = status_.status();
  had_gps_ = had_gps_ || status.gps == hdl64::GpsState::kFixed;
  if (status.power_level != 0 && power_level_of(status) != power_level_)
    set_power_level(power_level_of(status));
  if (status_.readings() != readings) calibration_difference_ = hdl64::compare(lasers_, status_.lasers());
}

/// Once GPS has set the sensor's clock that one is the better, GPS or not.
std::int64_t PacketIngest::clock_offset_at(std::int64_t sensor_ns) const noexcept {
  if (had_gps_) return 0;
  const std::int64_t offset_ns = clock_offset_.at(sensor_ns);
  if (status_.status().gps != hdl64::GpsState::kPulse) return offset_ns;
  return std::llround(static_cast<double>(offset_ns) / kSecond_ns) * kSecond_ns;
}

void PacketIngest::hold(const StampedPacket& packet, bool is_after_blind) noexcept {
  held_[num_held_].packet.take(packet);
  held_[num_held_].is_after_blind = is_after_blind;
  held_azimuths_[num_held_] = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns, format_);
  ++num_held_;
  if (num_held_ == hold_) release_held();
}

void PacketIngest::release_held() noexcept {
  if (num_held_ == 0) return;
  reconsider_format();
  if (format_.kind == hdl64::SensorKind::kHdl64S1) measure_times();
  const bool continues = tracker_.prime(std::span(held_azimuths_).first(num_held_), is_same_clock_);
  if (!continues) assembler_.interrupt();
  is_holding_ = false;
  is_same_clock_ = true;
  for (std::size_t i = 0; i < num_held_; ++i) assemble(held_[i].packet.packet(), held_[i].is_after_blind);
  num_held_ = 0;
}

void PacketIngest::assemble(const StampedPacket& packet, bool is_after_blind) noexcept {
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
                        .rate_rev_s = rate_rev_s,
                        .is_after_blind = is_after_blind && i == 0};
    const auto index = static_cast<std::size_t>(i);
    hdl64::FiringReturns* const others = format_.is_dual() ? &returns_.others[index] : nullptr;
    if (self_.has_box()) remove_own(returns_.strongest[index], others);
    assembler_.add(firing, returns_.strongest[index], others);
  }
  end_rotation_before_blind(start_rev, rate_rev_s * 1e-9 * static_cast<double>(format_.packet_period_ns()));
}

void PacketIngest::remove_own(hdl64::FiringReturns& strongest, hdl64::FiringReturns* others) noexcept {
  self_hits_ += static_cast<std::uint64_t>(self_.remove_own(strongest));
  if (others != nullptr) self_hits_ += static_cast<std::uint64_t>(self_.remove_own(*others));
}

/// If the next packet comes from beyond the cut only, the sweep need not wait for it.
void PacketIngest::end_rotation_before_blind(double start_rev, double packet_rev) noexcept {
  const double end_rev = start_rev + packet_rev;
  if (!blind_sector_.begins_at(end_rev, packet_rev)) return;
  const double next_cut_rev = std::ceil(end_rev - cut_rev_) + cut_rev_;
  if (blind_sector_.end_after(end_rev) > next_cut_rev) assembler_.end_rotation();
}

}  // namespace pago
