// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pago/assembly/assembler.hpp"
#include "pago/assembly/packet_sequencer.hpp"
#include "pago/assembly/self_filter.hpp"
#include "pago/config/hdl64.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/device_clock.hpp"
#include "pago/hdl64/rotation_tracker.hpp"
#include "pago/hdl64/stream_probe.hpp"

namespace pago {

/// The way of a datagram into a sweep:
///
///   check -> sensor time -> order -> (hold) -> rotation -> decode -> assemble
///
/// At the start of a stream, after a silence of more than 50 ms, a restart of the sensor's clock, or when the
/// head is not where it was expected, 64 packets (18 ms) are held back: they tell which sensor it is (at the
/// start) and how its head turns, so that even the first firing gets an azimuth good to 0.01 degrees. A pause
/// in the stream delays nothing else and loses nothing.
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

  PacketCounters packets() const noexcept;
  const FiringCounters& firings() const noexcept { return sequencer_.firings(); }
  const AssemblyCounters& sweeps() const noexcept { return assembler_.counters(); }

  /// The head's speed, 0 while it does not turn as a sensor does.
  double rotation_hz() const noexcept { return tracker_.is_spinning() ? tracker_.rate_rev_s() : 0.0; }
  /// Returns so far that were the vehicle's own body and left out.
  std::uint64_t self_hits() const noexcept { return self_hits_; }
  /// How often the sensor's clock began anew (power cycle, GPS found).
  std::uint64_t clock_restarts() const noexcept { return clock_.restarts(); }

 private:
  static constexpr std::size_t kHold = 64;

  void identify(const Datagram& datagram) noexcept;
  void restart_clock() noexcept;
  void sequence(const StampedPacket& packet) noexcept;
  void accept(const StampedPacket& packet) noexcept;
  void hold(const StampedPacket& packet) noexcept;
  void release_held() noexcept;
  void break_off() noexcept;
  void refuse() noexcept;
  void count_bad(PacketFault fault) noexcept { ++packets_.bad[static_cast<std::size_t>(fault)]; }
  void assemble(const StampedPacket& packet) noexcept;

  hdl64::StreamProbe probe_;
  hdl64::DeviceClock clock_;
  PacketSequencer sequencer_;
  hdl64::RotationTracker tracker_;
  hdl64::FiringDecoder decoder_;
  Assembler assembler_;

  std::int64_t stamp_to_first_firing_ns_;
  bool is_identified_ = false, is_refused_ = false;

  bool is_holding_ = true;
  bool is_same_clock_ = false;  // as before the packets that are held
  std::vector<PacketCopy> held_;
  std::vector<hdl64::PacketAzimuths> held_azimuths_;
  std::size_t num_held_ = 0;
  std::int64_t newest_ns_ = 0;

  SelfFilter self_;
  std::uint64_t self_hits_ = 0;
  hdl64::FiringReturns returns_{};
  PacketCounters packets_;
};

}  // namespace pago
