// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace pago::evaluation {

/// What a trajectory amounts to, for a first look and where there is no truth.
struct Motion {
  double path_length_m = 0.0;
  double yaw_range_rad = 0.0;  ///< max - min of the yaw about z, followed through full turns
  double furthest_m = 0.0;     ///< largest distance from the first position
  double end_m = 0.0;          ///< distance between the first and the last position
};

/// Poses of the sensor (x forward, y left, z up) in order; empty and single ones give zeros.
Motion motion_of(const std::vector<Eigen::Isometry3d>& poses);

/// Metres travelled up to each pose.
std::vector<double> distances_m(const std::vector<Eigen::Isometry3d>& poses);

}  // namespace pago::evaluation
