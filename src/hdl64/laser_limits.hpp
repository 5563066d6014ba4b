// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "pago/core/units.hpp"
#include "pago/hdl64/calibration.hpp"

/// What a calibration's figures must satisfy, whether they come from a file or from the sensor: limits far
/// beyond every real unit (radians, metres), so that only a wrong unit or damage fails.
namespace pago::hdl64 {

struct FigureLimit {
  double min, max;
  double LaserCalibration::*member;
};
inline constexpr std::array<FigureLimit, 9> kLimits{{
    {-15.0 * kDegree, 15.0 * kDegree, &LaserCalibration::rotation_rad},
    {-30.0 * kDegree, 30.0 * kDegree, &LaserCalibration::vertical_rad},
    {0.0, 2.5, &LaserCalibration::distance_m},
    {0.0, 2.7, &LaserCalibration::distance_x_m},
    {0.0, 2.7, &LaserCalibration::distance_y_m},
    {0.0, 0.3, &LaserCalibration::vertical_offset_m},
    {-0.05, 0.05, &LaserCalibration::horizontal_offset_m},
    {0.0, 131.0, &LaserCalibration::focal_distance_m},
    {0.0, 20.0, &LaserCalibration::focal_slope},
}};
/// Between the near point's distance corrections and the far one's.
inline constexpr double kMaxNearDifference_m = 0.2;

/// Where no near point was measured its figures are left out, or zero.
inline void fill_near_point(LaserCalibration& laser) noexcept {
  if (laser.distance_x_m == 0.0) laser.distance_x_m = laser.distance_m;
  if (laser.distance_y_m == 0.0) laser.distance_y_m = laser.distance_m;
}

inline bool is_plausible(const LaserCalibration& laser) noexcept {
  const bool within = std::all_of(kLimits.begin(), kLimits.end(), [&](const FigureLimit& limit) {
    return laser.*limit.member >= limit.min && laser.*limit.member <= limit.max;
  });
  return within && std::abs(laser.distance_x_m - laser.distance_m) < kMaxNearDifference_m &&
         std::abs(laser.distance_y_m - laser.distance_m) < kMaxNearDifference_m &&
         laser.min_intensity <= laser.max_intensity;
}

}  // namespace pago::hdl64
