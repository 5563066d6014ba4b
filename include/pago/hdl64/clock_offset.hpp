// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pago::hdl64 {

/// How the host's clock stands to the sensor's: what to add to sensor time. A packet arrives when it was sent
/// plus a delay that is never negative and often small, so the truth is the lower envelope of (arrival -
/// sensor time): the least of each second, over the last minute, and of the lines below all of these the one
/// nearest to them (Moon, Skelly, Towsley, INFOCOM 1999). Its slope is the drift.
///
/// The offset that is given out follows that line by 1 ms in a second at most, so that times made with it
/// rise. A host's clock that is set is not a drift: when all packets of a quarter of a second seem to come
/// 50 ms or more too early, or those of three seconds too late, all is measured anew and the offset steps.
///
/// [ingest thread] real-time safe; a packet costs a few nanoseconds, a second's end a microsecond.
class ClockOffset {
 public:
  /// Takes a packet whose last firing ended at `sensor_ns`.
  void add(std::int64_t sensor_ns, std::int64_t arrival_ns) noexcept;
  /// The sensor's clock began anew.
  void restart() noexcept { *this = {}; }

  /// Host time minus sensor time at a sensor time near the newest packet's; 0 before the first packet.
  std::int64_t at(std::int64_t sensor_ns) const noexcept;
  /// By how much the host's clock is faster, 1e-6; 0 until it is known.
  double drift_ppm() const noexcept { return 1e6 * slope_; }
  /// How often the host's clock was set.
  std::uint64_t steps() const noexcept { return steps_; }

 private:
  static constexpr std::size_t kSeconds = 64;
  /// The least delay of a second, and when; both relative to the first packet, so that they fit a double.
  struct Point {
    double t_s = 0.0, offset_s = 0.0;
  };

  void begin(std::int64_t sensor_ns, std::int64_t offset_ns) noexcept;
  bool has_stepped(const Point& point) noexcept;
  void end_second() noexcept;
  void fit() noexcept;
  double line_at(double t_s) const noexcept { return line_s_ + slope_ * (t_s - line_t_s_); }

  bool started_ = false;
  std::int64_t origin_ns_ = 0, origin_offset_ns_ = 0;
  std::array<Point, kSeconds> seconds_{};  // a ring
  std::size_t num_seconds_ = 0;
  Point least_{};  // of the second that is going on
  double second_began_s_ = 0.0;

  double line_t_s_ = 0.0, line_s_ = 0.0, slope_ = 0.0;    // the envelope
  double out_t_s_ = 0.0, out_s_ = 0.0, out_slope_ = 0.0;  // what is given out
  int too_early_ = 0, late_seconds_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace pago::hdl64
