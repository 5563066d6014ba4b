// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "pago/evaluation/association.hpp"

namespace pago::evaluation {

/// How the estimate's world is laid over the truth's before positions are compared. Never with scale.
enum class Alignment {
  kSe3,        ///< least squares over all positions (Umeyama 1991): evo's --align, KISS-ICP's ATE
  kYaw,        ///< least squares over position and yaw about z only: tilt stays an error (rpg's posyaw)
  kFirstPose,  ///< the first matched poses coincide
  kNone,       ///< as given
  kCount
};
std::string_view to_string(Alignment alignment) noexcept;

/// Absolute trajectory error over the matched poses. Axes are those of the truth's world, z up.
struct AbsoluteErrors {
  Alignment alignment = Alignment::kSe3;
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();  ///< the alignment that was used
  /// Of the distance between positions: the figures of evo_ape. The deviation is divided by n.
  double rmse_m = 0.0, mean_m = 0.0, median_m = 0.0, deviation_m = 0.0, min_m = 0.0, max_m = 0.0;
  Eigen::Vector3d axis_rmse_m = Eigen::Vector3d::Zero();  ///< x y z
  double rotation_rmse_rad = 0.0;  ///< of the angle between orientations, under the same alignment
  Eigen::Vector3d axis_rotation_rmse_rad = Eigen::Vector3d::Zero();  ///< roll pitch yaw
};

/// Error when no pose is matched. A straight path does not determine the SE(3) alignment's turn about itself:
/// positions are still comparable, rotation_rmse_rad then is not.
AbsoluteErrors absolute_errors(const MatchedTrajectories& matched, Alignment alignment);

/// T_truth_estimate of an alignment.
Eigen::Isometry3d align(const MatchedTrajectories& matched, Alignment alignment);

}  // namespace pago::evaluation
