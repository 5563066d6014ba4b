// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matched_paths.hpp"

#include <algorithm>

#include "pago/evaluation/motion.hpp"

namespace pago::evaluation {

MatchedPaths paths_of(const MatchedTrajectories& matched) {
  MatchedPaths paths;
  for (const MatchedPose& pose : matched.poses) {
    if (!pose.T_world_sensor_estimate) continue;
    paths.truth.push_back(pose.T_world_sensor_truth);
    paths.estimate.push_back(*pose.T_world_sensor_estimate);
  }
  return paths;
}

std::vector<double> true_distances_m(const MatchedTrajectories& matched) {
  std::vector<Eigen::Isometry3d> truth;
  for (const MatchedPose& pose : matched.poses) truth.push_back(pose.T_world_sensor_truth);
  return distances_m(truth);
}

std::size_t closest_distance(const std::vector<double>& distance_m, std::size_t first, double target_m) {
  const auto begin = distance_m.begin() + static_cast<std::ptrdiff_t>(first);
  auto after = std::lower_bound(begin, distance_m.end(), target_m);
  if (after == begin) return first;
  const double before_m = *std::prev(after);
  if (after == distance_m.end() || target_m - before_m <= *after - target_m)
    after = std::lower_bound(begin, after, before_m);
  return static_cast<std::size_t>(after - distance_m.begin());
}

Eigen::Isometry3d motion_error(const Eigen::Isometry3d& T_truth_from,
                               const Eigen::Isometry3d& T_truth_to,
                               const Eigen::Isometry3d& T_estimate_from,
                               const Eigen::Isometry3d& T_estimate_to) {
  return (T_truth_from.inverse() * T_truth_to).inverse() * (T_estimate_from.inverse() * T_estimate_to);
}

}  // namespace pago::evaluation
