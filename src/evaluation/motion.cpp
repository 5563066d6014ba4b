// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pago::evaluation {

std::vector<double> distances_m(const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<double> distances(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i)
    distances[i] = distances[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm();
  return distances;
}

Motion motion_of(const std::vector<Eigen::Isometry3d>& poses) {
  Motion motion;
  if (poses.empty()) return motion;
  motion.path_length_m = distances_m(poses).back();
  motion.end_m = (poses.back().translation() - poses.front().translation()).norm();

  double yaw_rad = 0.0, last_rad = 0.0, min_rad = 0.0, max_rad = 0.0;
  for (const Eigen::Isometry3d& T : poses) {
    const Eigen::Matrix3d R = poses.front().linear().transpose() * T.linear();
    const double now_rad = std::atan2(R(1, 0), R(0, 0));
    yaw_rad += std::remainder(now_rad - last_rad, 2.0 * std::numbers::pi);
    last_rad = now_rad;
    min_rad = std::min(min_rad, yaw_rad);
    max_rad = std::max(max_rad, yaw_rad);
    motion.furthest_m = std::max(motion.furthest_m, (T.translation() - poses.front().translation()).norm());
  }
  motion.yaw_range_rad = max_rad - min_rad;
  return motion;
}

}  // namespace pago::evaluation
