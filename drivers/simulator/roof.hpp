// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace pago::simulator {

/// Whether the roof that carries the sensor is in the way of a beam; the sensor is too close to it to see it.
/// `way`: where the beam goes, in base_link's axes, any length. As on KITTI's car, where of the lowest ring a
/// third is missing, ahead of the sensor below -21 degrees and behind it below -18.5: half an ellipse each,
/// in heights of the sensor above the roof.
inline bool meets_roof(const Eigen::Vector3d& way) noexcept {
  constexpr double kAhead = 2.6, kBesideAhead = 1.5, kBehind = 3.05, kBesideBehind = 1.8;
  if (way.z() >= 0.0) return false;
  const bool is_ahead = way.x() > 0.0;
  const double x = way.x() / (is_ahead ? kAhead : kBehind);
  const double y = way.y() / (is_ahead ? kBesideAhead : kBesideBehind);
  return x * x + y * y < way.z() * way.z();
}

}  // namespace pago::simulator
