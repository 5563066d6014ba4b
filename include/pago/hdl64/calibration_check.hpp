// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "pago/hdl64/calibration.hpp"

namespace pago::hdl64 {

/// How two calibrations differ, lasers' mean and largest figures in degrees and metres.
struct CalibrationDifference {
  double vertical_deg = 0.0, rotation_deg = 0.0, distance_m = 0.0;              ///< mean
  double max_vertical_deg = 0.0, max_rotation_deg = 0.0, max_distance_m = 0.0;  ///< largest
  int worst_laser = 0;                                                          ///< by its direction

  /// More than rounding and a careful user's own adjustments explain.
  bool is_other_unit() const noexcept {
    return vertical_deg > 0.05 || rotation_deg > 0.05 || distance_m > 0.02;
  }
};

/// [any thread] real-time safe.
CalibrationDifference compare(const std::array<LaserCalibration, 64>& a,
                              const std::array<LaserCalibration, 64>& b) noexcept;

/// A sentence for the user if `calibration` (where it came from) is not that of the sensor whose own figures
/// differ from it so; empty if it may well be. [any thread] allocates.
std::string complaint_about(const CalibrationDifference& difference, const std::string& calibration);

}  // namespace pago::hdl64
