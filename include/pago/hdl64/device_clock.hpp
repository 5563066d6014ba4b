// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pago::hdl64 {

/// Turns device stamps (microseconds since the top of the hour) into sensor time, nanoseconds since the Unix
/// epoch.
///
/// The hour is the one that puts the first stamp nearest to its arrival, never more than 30 minutes away.
/// From then on stamps are unwrapped by continuity: the device's clock alone decides intervals, so steps and
/// jitter of the host's clock do not reach sensor time. After a silence longer than half a second the host's
/// clock says which hour it is: a stamp that dropped by more than 1,800 s while the host advanced by less
/// than 30 minutes has rolled over. A unit without GPS counts from power-on, some beyond 3,600 s: their time
/// is then off by a constant of up to 30 minutes, and intervals are right all the same.
///
/// A stamp that fits neither is damaged, or the sensor was switched off and on, or has just found its GPS.
/// Eight such stamps that continue each other restart the clock at the last of them; sensor time may then
/// step, backwards too. [ingest thread] real-time safe.
class DeviceClock {
 public:
  enum class Verdict : std::uint8_t {
    kFits,        ///< time_ns continues what came before (perhaps after a gap)
    kRestarted,   ///< time_ns begins a new count, unrelated to earlier ones
    kImplausible  ///< no time; the packet is to be dropped
  };
  struct Reading {
    Verdict verdict = Verdict::kImplausible;
    std::int64_t time_ns = 0;
  };

  /// Reads the stamp of a packet that arrived at `arrival_ns` (since the Unix epoch).
  Reading read(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept;

  /// How often the count began anew after the first stamp.
  std::uint64_t restarts() const noexcept { return restarts_; }

 private:
  Reading start(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept;
  Reading doubt(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept;

  std::int64_t time_ns_ = 0, arrival_ns_ = 0;  // of the newest stamp
  std::int64_t stamp_us_ = 0;
  std::int64_t doubted_us_ = 0;  // the last implausible stamp, and how many continued each other up to it
  int doubts_ = 0;
  std::uint64_t restarts_ = 0;
  bool started_ = false;
};

}  // namespace pago::hdl64
