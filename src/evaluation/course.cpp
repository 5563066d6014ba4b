// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/course.hpp"

#include "matched_paths.hpp"
#include "rotation.hpp"

namespace pago::evaluation {

std::vector<CoursePoint> course_of(const MatchedTrajectories& matched, Alignment alignment) {
  const Eigen::Isometry3d T_aligned = align(matched, alignment);
  const Eigen::Isometry3d T_from_start = align(matched, Alignment::kFirstPose);
  const std::vector<double> distance_m = true_distances_m(matched);
  std::vector<CoursePoint> course;
  for (std::size_t i = 0; i < matched.poses.size(); ++i) {
    const MatchedPose& pose = matched.poses[i];
    if (!pose.T_world_sensor_estimate) continue;
    const Eigen::Isometry3d& truth = pose.T_world_sensor_truth;
    const Eigen::Isometry3d from_start = T_from_start * *pose.T_world_sensor_estimate;
    CoursePoint& point = course.emplace_back();
    point.row = pose.row;
    point.distance_m = distance_m[i];
    point.truth_m = truth.translation();
    point.estimate_m = (T_aligned * *pose.T_world_sensor_estimate).translation();
    point.error_m = (point.estimate_m - point.truth_m).norm();
    point.drift_m = from_start.translation() - truth.translation();
    point.drift_rpy_rad = roll_pitch_yaw_rad(truth.linear().transpose() * from_start.linear());
  }
  return course;
}

}  // namespace pago::evaluation
