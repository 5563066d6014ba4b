// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Whose packets these are: which sender, which sensor, which return mode, and when one of these changes.
// Their way to the assembler is in packet_ingest.cpp.
#include <utility>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/hdl64/block_times.hpp"

namespace pago {

namespace {

/// From one look at the stream's kind to the next. Two that agree against the present one change it.
constexpr std::uint32_t kWatchEvery = 16;
constexpr int kDisagreements = 2;

}  // namespace

bool PacketIngest::is_foreign(const Datagram& datagram) noexcept {
  switch (sender_.judge(datagram)) {
    case SenderLock::Verdict::kForeign:
      return true;
    case SenderLock::Verdict::kReplaced:
      // Another sensor: nothing that is known holds for it.
      if (is_identified_) {
        restart_clock();
        clock_ = {};
        status_ = {};
        probe_ = {};
        is_identified_ = false;
        ++format_changes_;
      }
      return false;
    case SenderLock::Verdict::kOurs:
      break;
  }
  return false;
}

// Until the sensor is known nobody can tell what is wrong with a packet: all wait.
void PacketIngest::identify(const Datagram& datagram) noexcept {
  probe_.add(datagram.payload, datagram.arrival_ns);
  unidentified_[num_unidentified_++].take(
      {datagram.payload.first<hdl64::kPacketBytes>(), 0, datagram.arrival_ns});
  if (!probe_.decided()) return;
  is_identified_ = hdl64::is_supported(probe_.kind());
  if (!is_identified_) return give_up_sender();
  set_format(hdl64::format_of(probe_.kind(), probe_.packet_period_ns()));
  for (std::size_t i = 0, n = std::exchange(num_unidentified_, 0); i < n; ++i)
    take(unidentified_[i].bytes, unidentified_[i].arrival_ns);
}

/// The sender is no HDL-64E. That is the end of it, unless there are others.
void PacketIngest::give_up_sender() noexcept {
  if (packets_.filtered == 0 && packets_.decoded == 0) return refuse_stream();
  packets_.filtered += std::exchange(num_unidentified_, 0);
  probe_ = {};
  sender_.ban();
}

// A user may switch the return mode of a running sensor.
void PacketIngest::watch(const Datagram& datagram) noexcept {
  if (until_watch_ > 0) {
    --until_watch_;
    return;
  }
  watch_.add(datagram.payload, datagram.arrival_ns);
  if (!watch_.decided()) return;
  const hdl64::StreamFormat seen = format_seen(watch_);
  watch_ = {};
  until_watch_ = kWatchEvery;
  disagreements_ = seen == format_ ? 0 : seen == watched_ ? disagreements_ + 1 : 1;
  watched_ = seen;
  if (disagreements_ < kDisagreements) return;
  use_all_held();
  is_holding_ = true;
  hold_ = kHold;
  if (seen != format_) change_format(seen);
}

/// The present one where a probe is not certain.
hdl64::StreamFormat PacketIngest::format_seen(const hdl64::StreamProbe& probe) const noexcept {
  if (!probe.decided() || !hdl64::is_supported(probe.kind())) return format_;
  const std::int64_t period_ns = probe.packet_period_ns();
  const hdl64::StreamFormat seen = hdl64::format_of(probe.kind(), period_ns);
  return seen.has_stamps() && !seen.has_period(period_ns) ? format_ : seen;
}

void PacketIngest::change_format(const hdl64::StreamFormat& format) noexcept {
  assembler_.interrupt();
  set_format(format);
  ++format_changes_;
  disagreements_ = 0;
}

void PacketIngest::set_format(const hdl64::StreamFormat& format) noexcept {
  const auto times = hdl64::AzimuthTimes::of(format, format.block_times_ns());
  format_ = format;
  arrival_clock_.set_format(format, times);
  sequencer_.set_format(format);
  tracker_.set_times(times);
  decoder_.set_format(format);
  assembler_.set_format(format);
  blind_sector_.forget();
}

void PacketIngest::set_power_level(hdl64::PowerLevel level) noexcept {
  power_level_ = level;
  decoder_.set_power_level(level);
}

/// Packets are held where the stream is not what it was: perhaps it has become one of another kind.
void PacketIngest::reconsider_format() noexcept {
  hdl64::StreamProbe probe;
  for (std::size_t i = 0; i < num_held_ && !probe.decided(); ++i)
    probe.add(held_[i].packet.bytes, held_[i].packet.arrival_ns);
  const hdl64::StreamFormat seen = format_seen(probe);
  if (seen == format_) return;
  change_format(seen);
  for (std::size_t i = 0; i < num_held_; ++i) {
    const StampedPacket packet = held_[i].packet.packet();
    held_azimuths_[i] = hdl64::PacketAzimuths::of(packet.view(), packet.time_ns, format_);
  }
}

void PacketIngest::measure_times() noexcept {
  const auto times =
      hdl64::measure_block_times(std::span(held_azimuths_).first(num_held_), format_.packet_period_ns());
  if (!times) return;
  const hdl64::PacketLayout& layout = format_.layout(held_[0].packet.packet().view());
  tracker_.set_times(hdl64::AzimuthTimes::of(format_, *times));
  decoder_.set_block_times(*times, hdl64::lower_delay_ns(layout, *times));
}

}  // namespace pago
