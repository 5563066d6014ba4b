// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motions.hpp"

#include <cmath>

#include "pago/core/se3.hpp"

namespace pago::evaluation {

Motion6 motion_between(const Eigen::Isometry3d& T_from, const Eigen::Isometry3d& T_to) {
  const Eigen::Isometry3d T = T_from.inverse() * T_to;
  return {T.translation(), log_so3(T.linear())};
}

std::vector<MotionPair> motion_pairs(const MatchedTrajectories& matched) {
  std::vector<MotionPair> pairs;
  for (std::size_t i = 1; i < matched.poses.size(); ++i) {
    const MatchedPose &from = matched.poses[i - 1], &to = matched.poses[i];
    if (from.T_world_sensor_estimate && to.T_world_sensor_estimate)
      pairs.push_back({motion_between(from.T_world_sensor_truth, to.T_world_sensor_truth),
                       motion_between(*from.T_world_sensor_estimate, *to.T_world_sensor_estimate)});
  }
  return pairs;
}

Misfit misfit_of(const std::vector<MotionPair>& pairs) {
  Misfit misfit;
  for (const MotionPair& pair : pairs) {
    misfit.translation_sq += (pair.truth.translation_m - pair.estimate.translation_m).squaredNorm();
    misfit.rotation_sq += (pair.truth.rotation_rad - pair.estimate.rotation_rad).squaredNorm();
  }
  return misfit;
}

double gain(const Misfit& before, const Misfit& after, std::size_t num_motions) {
  // Rounding of files with four decimals.
  const double n = static_cast<double>(num_motions), floor_sq = n * 1e-4 * 1e-4;
  return std::log((before.translation_sq + floor_sq) / (after.translation_sq + floor_sq)) +
         std::log((before.rotation_sq + floor_sq) / (after.rotation_sq + floor_sq));
}

}  // namespace pago::evaluation
