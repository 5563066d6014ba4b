// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pago/assembly/assembler.hpp"
#include "pago/assembly/blind_sector.hpp"
#include "pago/assembly/packet_sequencer.hpp"
#include "pago/assembly/self_filter.hpp"
#include "pago/assembly/sender_lock.hpp"
#include "pago/config/hdl64.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/arrival_clock.hpp"
#include "pago/hdl64/calibration_check.hpp"
#include "pago/hdl64/clock_offset.hpp"
#include "pago/hdl64/device_clock.hpp"
#include "pago/hdl64/packet_decoder.hpp"
#include "pago/hdl64/rotation_tracker.hpp"
#include "pago/hdl64/status_reader.hpp"
#include "pago/hdl64/stream_probe.hpp"

namespace pago {

/// The way of a datagram into a sweep:
///
///   sender -> identify -> check -> sensor time -> order -> status -> (hold) -> rotation -> decode ->
///   assemble
///
/// Model, return mode, firing period and speed are found from the stream, and found again when they change.
/// The sender of the first packet is the sensor; packets of others on the same port are filtered, until it
/// has been silent for five seconds.
///
/// At the start of a stream, after a silence of more than 50 ms, a restart of the sensor's clock, or when the
/// head is not where it was expected, 64 packets (18 ms) are held back: they tell which sensor it is (at the
/// start) and how its head turns, so that even the first firing gets an azimuth good to 0.01 degrees. A pause
/// in the stream delays nothing else and loses nothing. A sensor whose field of view is limited pauses in
/// every turn; 12 packets do then, and a sweep ends when no more of it can come.
///
/// Sensor time, on which sweeps are built, comes from the device's stamps; how it stands to the time of day
/// is in each sweep's header: GPS time where the sensor has it, else the host's clock.
///
/// A silence of more than 0.3 s ends a stream: the open sweep is closed, and what comes later begins anew.
/// The stamps of the next packet show it, so a replay does the same; a live source says so earlier
/// (note_silence), or the last sweep would wait for a sensor that was switched off.
///
/// Of a sensor that PaGO cannot read nothing is decoded, nor of a stream that ends before its sensor is
/// known: refusal() says which it is. Its datagrams count as bad (kOtherSensor).
///
/// [set-up] constructor allocates; [ingest thread] the rest, real-time safe.
class PacketIngest {
 public:
  PacketIngest(const AssemblyConfig& assembly,
               const Hdl64Config& sensor,
               const hdl64::Calibration& calibration,
               SweepExchange& exchange,
               const SelfFilter& self = {});

  /// Takes the next datagram in order of arrival. May acquire a sweep and hand parts on.
  void push(const Datagram& datagram) noexcept;

  /// Nothing has come for more than kBrokenOff_ns: uses what is held back and closes the open sweep.
  static constexpr std::int64_t kBrokenOff_ns = 300'000'000;
  void note_silence() noexcept;

  /// Whatever was refused may have been replaced: looks again at what comes. Without effect otherwise.
  void probe_again() noexcept;

  /// The stream is over: uses what is held back and closes the open sweep.
  void finish() noexcept;

  /// True once it is certain that the stream cannot be used; push() only counts what still comes.
  bool is_refused() const noexcept { return is_refused_; }
  /// Why, in one sentence for the user; empty while all is well. [any but the hot path] allocates.
  std::string refusal() const;
  /// What the stream comes from; kUnknown until that is certain.
  hdl64::SensorKind sensor() const noexcept { return probe_.kind(); }
  /// How its packets are laid out; has no meaning before the sensor is known.
  const hdl64::StreamFormat& format() const noexcept { return format_; }
  const SenderLock& sender() const noexcept { return sender_; }

  PacketCounters packets() const noexcept;
  const FiringCounters& firings() const noexcept { return sequencer_.firings(); }
  const AssemblyCounters& sweeps() const noexcept { return assembler_.counters(); }

  /// The head's speed, 0 while it does not turn as a sensor does.
  double rotation_hz() const noexcept { return tracker_.is_spinning() ? tracker_.rate_rev_s() : 0.0; }
  /// Returns so far that were the vehicle's own body and left out.
  std::uint64_t self_hits() const noexcept { return self_hits_; }
  /// How often the sensor's clock began anew (power cycle, GPS found).
  std::uint64_t clock_restarts() const noexcept { return clock_.restarts(); }
  /// How often the stream became another one: return mode switched, another sensor.
  std::uint64_t format_changes() const noexcept { return format_changes_; }
  /// True once it is known that the sensor looks at a part of the circle only.
  bool is_view_limited() const noexcept { return blind_sector_.is_known(); }

  /// What the sensor says of itself, and its own calibration as far as it came.
  const hdl64::StatusReader& status() const noexcept { return status_; }
  /// How the calibration in use differs from the sensor's own; nothing before that has come.
  const std::optional<hdl64::CalibrationDifference>& calibration_difference() const noexcept {
    return calibration_difference_;
  }
  /// How the host's clock stands to the sensor's.
  const hdl64::ClockOffset& clock_offset() const noexcept { return clock_offset_; }

 private:
  using Bytes = std::span<const std::uint8_t, hdl64::kPacketBytes>;
  static constexpr std::size_t kHold = 64, kShortHold = 12;

  bool is_foreign(const Datagram& datagram) noexcept;
  void identify(const Datagram& datagram) noexcept;
  void give_up_sender() noexcept;
  void watch(const Datagram& datagram) noexcept;
  hdl64::StreamFormat format_seen(const hdl64::StreamProbe& probe) const noexcept;
  void change_format(const hdl64::StreamFormat& format) noexcept;
  void set_format(const hdl64::StreamFormat& format) noexcept;
  void set_power_level(hdl64::PowerLevel level) noexcept;
  void take(Bytes bytes, std::int64_t arrival_ns) noexcept;
  hdl64::DeviceClock::Reading read_clock(Bytes bytes, std::int64_t arrival_ns) noexcept;
  void refuse_stream() noexcept;
  void refuse(PacketFault fault) noexcept;
  void count_bad(PacketFault fault) noexcept { ++packets_.bad[static_cast<std::size_t>(fault)]; }
  void break_off() noexcept;
  void use_all_held() noexcept;
  void restart_clock() noexcept;
  void sequence(const StampedPacket& packet) noexcept;
  void accept(const StampedPacket& packet) noexcept;
  bool note_gap(const StampedPacket& packet) noexcept;
  void read_status(const StampedPacket& packet, std::int64_t packets_on) noexcept;
  std::int64_t clock_offset_at(std::int64_t sensor_ns) const noexcept;
  void hold(const StampedPacket& packet, bool is_after_blind) noexcept;
  void release_held() noexcept;
  void reconsider_format() noexcept;
  void measure_times() noexcept;
  void assemble(const StampedPacket& packet, bool is_after_blind) noexcept;
  void remove_own(hdl64::FiringReturns& strongest, hdl64::FiringReturns* others) noexcept;
  void end_rotation_before_blind(double start_rev, double packet_rev) noexcept;

  SenderLock sender_;
  hdl64::StreamProbe probe_;
  hdl64::StreamFormat format_;
  hdl64::DeviceClock clock_;
  hdl64::ArrivalClock arrival_clock_;
  hdl64::ClockOffset clock_offset_;
  PacketSequencer sequencer_;
  BlindSector blind_sector_;
  hdl64::StatusReader status_;
  hdl64::RotationTracker tracker_;
  hdl64::PacketDecoder decoder_;
  Assembler assembler_;

  PacketStamp stamp_names_;
  double cut_rev_;
  bool is_identified_ = false, is_refused_ = false;
  std::vector<PacketCopy> unidentified_;
  std::size_t num_unidentified_ = 0;

  // Whether the stream is still of the same kind: looked at now and then.
  hdl64::StreamProbe watch_;
  std::uint32_t until_watch_ = 0;
  hdl64::StreamFormat watched_;
  int disagreements_ = 0;
  std::uint64_t format_changes_ = 0;

  std::array<hdl64::LaserCalibration, hdl64::kLasers> lasers_;  // as the calibration in use has them
  std::optional<hdl64::CalibrationDifference> calibration_difference_;
  hdl64::PowerLevel power_level_;
  bool had_gps_ = false;  // since the sensor's clock began

  /// What is held back until it is known how the head turns.
  struct Held {
    PacketCopy packet;
    bool is_after_blind = false;
  };
  bool is_holding_ = true;
  bool is_same_clock_ = false;  // as before the packets that are held
  std::size_t hold_ = kHold;    // so many
  std::vector<Held> held_;
  std::vector<hdl64::PacketAzimuths> held_azimuths_;
  std::size_t num_held_ = 0;
  std::int64_t newest_ns_ = 0;
  double newest_end_rev_ = 0.0;  // header azimuth at the end of the newest packet, [0, 1)

  SelfFilter self_;
  std::uint64_t self_hits_ = 0;
  hdl64::PacketReturns returns_{};
  PacketCounters packets_;
};

}  // namespace pago
