// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "pago/hdl64/calibration.hpp"

namespace pago::simulator {

/// Which way a laser looks: sine and cosine of encoder azimuth minus rotCorrection, clockwise from ahead.
struct Heading {
  double cos = 1.0, sin = 0.0;
};

/// A straight line along which points lie at distances d: point = foot + d * step.
struct Line {
  Eigen::Vector3d foot, step;
};

/// The decoder's formulas (hdl64/packet_decoder.hpp) read backwards: the line on which a laser's returns lie
/// for a heading, as a function of range (raw distance plus distCorrection), and the raw distance for a point
/// on it. With a two-point calibration returns below 25 m lie on a line of their own, a few centimetres
/// beside the first and a little steeper or flatter. Frame `sensor`. [any thread] pure.
class LaserLine {
 public:
  LaserLine() = default;
  LaserLine(const hdl64::LaserCalibration& laser, hdl64::Calibration const& unit);

  /// Where the beam runs: the line of far returns, a unit vector its step.
  Line far(const Heading& heading) const noexcept;
  /// The line of returns nearer than kNearLimit_m.
  Line near(const Heading& heading) const noexcept;

  /// The range that the unit measures for the surface that a beam meets after `range_m` and that lies across
  /// it with this normal (sensor frame, any length): where the line of returns meets the surface's plane.
  double measured_m(const Heading& heading, double range_m, const Eigen::Vector3d& normal) const noexcept;

  /// Not rounded: a packet holds the nearest whole number.
  double raw(double measured_m) const noexcept { return (measured_m - distance_m_) / lsb_m_; }

  static constexpr double kNearLimit_m = 25.0;

 private:
  double cos_vertical_ = 1.0, sin_vertical_ = 0.0;
  double xy_offset_m_ = 0.0, z_offset_m_ = 0.0, horizontal_offset_m_ = 0.0;
  double near_slope_x_ = 0.0, near_slope_y_ = 0.0;
  double distance_m_ = 0.0, lsb_m_ = 0.002;
  bool two_point_ = false;
};

}  // namespace pago::simulator
