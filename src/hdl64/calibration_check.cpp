// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/calibration_check.hpp"

#include <algorithm>
#include <cmath>

#include "laser_limits.hpp"
#include "pago/core/text.hpp"

namespace pago::hdl64 {

CalibrationDifference compare(const std::array<LaserCalibration, 64>& a,
                              const std::array<LaserCalibration, 64>& b) noexcept {
  CalibrationDifference d;
  double worst_deg = -1.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double vertical_deg = std::abs(a[i].vertical_rad - b[i].vertical_rad) / kDegree;
    const double rotation_deg = std::abs(a[i].rotation_rad - b[i].rotation_rad) / kDegree;
    const double distance_m = std::abs(a[i].distance_m - b[i].distance_m);
    d.vertical_deg += vertical_deg / 64.0;
    d.rotation_deg += rotation_deg / 64.0;
    d.distance_m += distance_m / 64.0;
    d.max_vertical_deg = std::max(d.max_vertical_deg, vertical_deg);
    d.max_rotation_deg = std::max(d.max_rotation_deg, rotation_deg);
    d.max_distance_m = std::max(d.max_distance_m, distance_m);
    if (std::max(vertical_deg, rotation_deg) <= worst_deg) continue;
    worst_deg = std::max(vertical_deg, rotation_deg);
    d.worst_laser = static_cast<int>(i);
  }
  return d;
}

std::string complaint_about(const CalibrationDifference& difference, const std::string& calibration) {
  if (!difference.is_other_unit()) return {};
  return "wrong calibration: " + calibration +
         format(
             " differs from what the sensor says of itself by %.2f deg in the lasers' vertical angles, "
             "%.2f deg in their rotations and %.3f m in their distances (means; most at laser %d, by %.2f "
             "deg); use this unit's own file, or none",
             difference.vertical_deg, difference.rotation_deg, difference.distance_m, difference.worst_laser,
             std::max(difference.max_vertical_deg, difference.max_rotation_deg));
}

}  // namespace pago::hdl64
