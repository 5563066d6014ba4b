// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "pago/core/units.hpp"
#include "pago/hdl64/calibration.hpp"

namespace pago::test {

/// A unit of figures that the status bytes can express exactly.
inline hdl64::Calibration some_unit(unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto within = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  hdl64::Calibration unit;
  for (hdl64::LaserCalibration& laser : unit.lasers) {
    laser.vertical_rad = within(-2500, 500) * 0.01 * kDegree;
    laser.rotation_rad = within(-1000, 1000) * 0.01 * kDegree;
    const int distance_mm = within(800, 1600);
    laser.distance_m = distance_mm * 1e-3;
    laser.distance_x_m = (distance_mm + within(-100, 100)) * 1e-3;
    laser.distance_y_m = (distance_mm + within(-100, 100)) * 1e-3;
    laser.vertical_offset_m = within(100, 220) * 1e-3;
    laser.horizontal_offset_m = within(-26, 26) * 1e-3;
    laser.focal_distance_m = within(500, 25'000) * 1e-3;
    laser.focal_slope = within(0, 20) * 0.1;
    laser.min_intensity = static_cast<std::uint8_t>(within(0, 40));
    laser.max_intensity = static_cast<std::uint8_t>(within(200, 255));
  }
  return unit;
}

}  // namespace pago::test
