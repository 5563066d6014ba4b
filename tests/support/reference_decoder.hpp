// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "pago/hdl64/calibration.hpp"

namespace pago::test {

struct ReferenceReturn {
  bool is_valid = false;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double intensity = 0.0;  ///< not rounded
};

/// One return of the HDL-64E by the manual's formulas (S3 manual p. 10, hdl64 notes section 6), in double and
/// in their order, for comparing: nothing is shared with the decoder. `azimuth_rad` is the encoder's at the
/// instant the laser fires, before rotCorrection.
inline ReferenceReturn reference_return(const hdl64::Calibration& calibration,
                                        int laser,
                                        int raw,
                                        int intensity,
                                        double azimuth_rad,
                                        double min_range_m,
                                        double max_range_m) {
  const hdl64::LaserCalibration& cal = calibration.lasers[static_cast<std::size_t>(laser)];
  const double d1 = raw * calibration.distance_lsb_m;
  const double d = d1 + cal.distance_m;

  const double theta = azimuth_rad - cal.rotation_rad;
  const double c = std::cos(theta), s = std::sin(theta);
  const double cv = std::cos(cal.vertical_rad), sv = std::sin(cal.vertical_rad);
  const double h = cal.horizontal_offset_m, vo = cal.vertical_offset_m;
  const bool perpendicular = calibration.vertical_offset == VerticalOffset::kPerpendicular;
  const double xy_shift = perpendicular ? -vo * sv : 0.0;
  const double z_shift = perpendicular ? vo * cv : vo;

  double dX = cal.distance_m, dY = cal.distance_m;
  if (d < 25.0) {
    const double xy = d * cv + xy_shift;
    const double xx = std::abs(xy * s - h * c);
    const double yy = std::abs(xy * c + h * s);
    dX = cal.distance_x_m + (cal.distance_m - cal.distance_x_m) * (xx - 2.40) / (25.04 - 2.40);
    dY = cal.distance_y_m + (cal.distance_m - cal.distance_y_m) * (yy - 1.93) / (25.04 - 1.93);
  }
  const double x_right = ((d1 + dX) * cv + xy_shift) * s - h * c;
  const double y_forward = ((d1 + dY) * cv + xy_shift) * c + h * s;
  const double z_up = (d1 + dY) * sv + z_shift;

  ReferenceReturn result;
  result.is_valid = cal.enabled && raw != 0 && d >= min_range_m && d <= max_range_m;
  result.x_m = y_forward;
  result.y_m = -x_right;
  result.z_m = z_up;

  const auto square = [](double v) { return v * v; };
  const double focal_offset = 256.0 * square(1.0 - cal.focal_distance_m / 131.0);
  const double corrected =
      intensity + cal.focal_slope * std::abs(focal_offset - 256.0 * square(1.0 - raw / 65535.0));
  const bool has_slopes = std::any_of(calibration.lasers.begin(), calibration.lasers.end(),
                                      [](const auto& l) { return l.focal_slope != 0.0; });
  result.intensity =
      has_slopes ? std::clamp<double>(corrected, cal.min_intensity, cal.max_intensity) : intensity;
  return result;
}

}  // namespace pago::test
