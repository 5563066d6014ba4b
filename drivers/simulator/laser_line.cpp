// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "laser_line.hpp"

#include <cmath>

namespace pago::simulator {

namespace {

// Where the two-point calibration was taken (S3 manual, p. 10).
constexpr double kFarDistance_m = 25.04, kNearX_m = 2.40, kNearY_m = 1.93;

}  // namespace

LaserLine::LaserLine(const hdl64::LaserCalibration& laser, const hdl64::Calibration& unit)
    : cos_vertical_(std::cos(laser.vertical_rad)),
      sin_vertical_(std::sin(laser.vertical_rad)),
      horizontal_offset_m_(laser.horizontal_offset_m),
      near_slope_x_((laser.distance_x_m - laser.distance_m) / (kFarDistance_m - kNearX_m)),
      near_slope_y_((laser.distance_y_m - laser.distance_m) / (kFarDistance_m - kNearY_m)),
      distance_m_(laser.distance_m),
      lsb_m_(unit.distance_lsb_m),
      two_point_(near_slope_x_ != 0.0 || near_slope_y_ != 0.0) {
  const bool perpendicular = unit.vertical_offset == VerticalOffset::kPerpendicular;
  xy_offset_m_ = perpendicular ? -laser.vertical_offset_m * sin_vertical_ : 0.0;
  z_offset_m_ = perpendicular ? laser.vertical_offset_m * cos_vertical_ : laser.vertical_offset_m;
}

Line LaserLine::far(const Heading& heading) const noexcept {
  const double c = heading.cos, s = heading.sin, h = horizontal_offset_m_;
  return {{xy_offset_m_ * c + h * s, h * c - xy_offset_m_ * s, z_offset_m_},
          {cos_vertical_ * c, -cos_vertical_ * s, sin_vertical_}};
}

// The near corrections are linear in the distance, as long as the point stays on its side of both axes:
// added_x = slope_x (25.04 m - |xy s - h c|), added_y = slope_y (25.04 m - |xy c + h s|), xy = d cos v +
// offset.
Line LaserLine::near(const Heading& heading) const noexcept {
  const double c = heading.cos, s = heading.sin, h = horizontal_offset_m_;
  const double side_x = s < 0.0 ? -1.0 : 1.0, side_y = c < 0.0 ? -1.0 : 1.0;
  const double added_x = near_slope_x_ * (kFarDistance_m - side_x * (xy_offset_m_ * s - h * c));
  const double added_y = near_slope_y_ * (kFarDistance_m - side_y * (xy_offset_m_ * c + h * s));
  const double added_x_step = -near_slope_x_ * side_x * cos_vertical_ * s;
  const double added_y_step = -near_slope_y_ * side_y * cos_vertical_ * c;
  const Line straight = far(heading);
  return {{straight.foot.x() + added_y * straight.step.x(), straight.foot.y() + added_x * straight.step.y(),
           straight.foot.z() + added_y * straight.step.z()},
          {straight.step.x() * (1.0 + added_y_step), straight.step.y() * (1.0 + added_x_step),
           straight.step.z() * (1.0 + added_y_step)}};
}

double LaserLine::measured_m(const Heading& heading,
                             double range_m,
                             const Eigen::Vector3d& normal) const noexcept {
  if (!two_point_ || range_m >= kNearLimit_m) return range_m;
  const Line beam = far(heading), line = near(heading);
  const double across = normal.dot(line.step);
  // Beams that graze a surface: its plane says nothing about the distance.
  constexpr double kGrazing = 0.01;
  if (std::abs(across) < kGrazing * normal.norm()) return range_m;
  const Eigen::Vector3d point = beam.foot + range_m * beam.step;
  return normal.dot(point - line.foot) / across;
}

}  // namespace pago::simulator
