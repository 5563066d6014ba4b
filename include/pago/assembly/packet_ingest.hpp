// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pago/assembly/assembler.hpp"
#include "pago/assembly/packet_sequencer.hpp"
#include "pago/config/hdl64.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/arrival_clock.hpp"
#include "pago/hdl64/device_clock.hpp"
#include "pago/hdl64/packet_decoder.hpp"
#include "pago/hdl64/rotation_tracker.hpp"
#include "pago/hdl64/stream_probe.hpp"

namespace pago {

/// The way of a datagram into a sweep:
///
///   identify -> check -> sensor time -> order -> (hold) -> rotation -> decode -> assemble
///
/// At the start of a stream, after a silence of more than 50 ms, a restart of the sensor's clock, or when the
/// head is not where it was expected, 64 packets (18 ms) are held back: they tell which sensor it is (at the
/// start) and how its head turns, so that even the first firing gets an azimuth good to 0.01 degrees. A pause
/// in the stream delays nothing else and loses nothing.
///
/// Of a sensor that PaGO cannot read nothing is decoded, nor of a stream that ends before its sensor is
/// known: refusal() says which it is.
///
/// [set-up] constructor allocates; [ingest thread] the rest, real-time safe.
class PacketIngest {
 public:
  PacketIngest(const AssemblyConfig& assembly,
               const Hdl64Config& sensor,
               const hdl64::Calibration& calibration,
               SweepExchange& exchange);

  /// Takes the next datagram in order of arrival. May acquire a sweep and hand parts on.
  void push(const Datagram& datagram) noexcept;

  /// The stream is over: uses what is held back and closes the open sweep.
  void finish() noexcept;

  /// True once it is certain that the stream cannot be used; push() ignores what still comes.
  bool is_refused() const noexcept { return is_refused_; }
  /// Why, in one sentence for the user; empty while all is well. [any but the hot path] allocates.
  std::string refusal() const;
  /// What the stream comes from; kUnknown until that is certain.
  hdl64::SensorKind sensor() const noexcept { return probe_.kind(); }
  /// How its packets are laid out; has no meaning before the sensor is known.
  const hdl64::StreamFormat& format() const noexcept { return format_; }

  PacketCounters packets() const noexcept;
  const FiringCounters& firings() const noexcept { return sequencer_.firings(); }
  const AssemblyCounters& sweeps() const noexcept { return assembler_.counters(); }

  /// The head's speed, 0 while it does not turn as a sensor does.
  double rotation_hz() const noexcept { return tracker_.is_spinning() ? tracker_.rate_rev_s() : 0.0; }
  /// How often the sensor's clock began anew (power cycle, GPS found).
  std::uint64_t clock_restarts() const noexcept { return clock_.restarts(); }

 private:
  using Bytes = std::span<const std::uint8_t, hdl64::kPacketBytes>;
  static constexpr std::size_t kHold = 64;

  void identify(const Datagram& datagram) noexcept;
  void set_format(const hdl64::StreamFormat& format) noexcept;
  void take(Bytes bytes, std::int64_t arrival_ns) noexcept;
  hdl64::DeviceClock::Reading read_clock(Bytes bytes, std::int64_t arrival_ns) noexcept;
  void refuse(PacketFault fault) noexcept;
  void restart_clock() noexcept;
  void sequence(const StampedPacket& packet) noexcept;
  void accept(const StampedPacket& packet) noexcept;
  void hold(const StampedPacket& packet) noexcept;
  void release_held() noexcept;
  void measure_times() noexcept;
  void assemble(const StampedPacket& packet) noexcept;

  hdl64::StreamProbe probe_;
  hdl64::StreamFormat format_;
  hdl64::DeviceClock clock_;
  hdl64::ArrivalClock arrival_clock_;
  PacketSequencer sequencer_;
  hdl64::RotationTracker tracker_;
  hdl64::PacketDecoder decoder_;
  Assembler assembler_;

  PacketStamp stamp_names_;
  bool is_identified_ = false, is_refused_ = false;
  std::vector<PacketCopy> unidentified_;
  std::size_t num_unidentified_ = 0;

  bool is_holding_ = true;
  bool is_same_clock_ = false;  // as before the packets that are held
  std::vector<PacketCopy> held_;
  std::vector<hdl64::PacketAzimuths> held_azimuths_;
  std::size_t num_held_ = 0;
  std::int64_t newest_ns_ = 0;

  hdl64::PacketReturns returns_{};
  PacketCounters packets_;
};

}  // namespace pago
