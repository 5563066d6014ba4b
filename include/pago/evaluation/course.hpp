// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "pago/evaluation/absolute_error.hpp"
#include "pago/evaluation/association.hpp"

namespace pago::evaluation {

/// One matched pose on the way.
struct CoursePoint {
  std::size_t row = 0;
  double distance_m = 0.0;  ///< travelled along the truth, rows without estimate included
  Eigen::Vector3d truth_m = Eigen::Vector3d::Zero();     ///< in the truth's world
  Eigen::Vector3d estimate_m = Eigen::Vector3d::Zero();  ///< under the alignment that was asked for
  double error_m = 0.0;                                  ///< between the two
  /// What has added up since the start: estimated motion since the first matched pose against the true one.
  /// Position error along the axes of the truth's world, orientation error about the sensor's.
  Eigen::Vector3d drift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d drift_rpy_rad = Eigen::Vector3d::Zero();
};

/// The matched poses in order, for plots. Error when no pose is matched.
std::vector<CoursePoint> course_of(const MatchedTrajectories& matched, Alignment alignment);

}  // namespace pago::evaluation
