// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "demo_report.hpp"

#include "pago/evaluation/absolute_error.hpp"
#include "pago/evaluation/motion.hpp"
#include "pago/evaluation/trajectory.hpp"

namespace pago::app {

DemoAccuracy judge_accuracy(const std::vector<output::SweepRecord>& records, const std::string& truth) {
  const evaluation::Trajectory rows = evaluation::read_trajectory(truth);
  evaluation::MatchedTrajectories matched;
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t row = 0; row < rows.poses.size(); ++row) {
    matched.poses.push_back({.row = row,
                             .stamp_ns = {},
                             .T_world_sensor_truth = rows.poses[row].T_world_sensor,
                             .T_world_sensor_estimate = {}});
    path.push_back(rows.poses[row].T_world_sensor);
  }
  DemoAccuracy accuracy;
  for (const output::SweepRecord& record : records) {
    if (!record.has_pose || record.header.sequence >= matched.poses.size()) continue;
    evaluation::MatchedPose& pose = matched.poses[record.header.sequence];
    pose.T_world_sensor_estimate = output::to_isometry(record.T_odom_sensor_refined);
    pose.estimate_row = static_cast<std::size_t>(accuracy.num_poses++);
  }
  accuracy.num_rows = matched.poses.size();
  if (accuracy.num_poses == 0) return accuracy;
  accuracy.path_m = evaluation::distances_m(path).back();
  accuracy.ate_m = evaluation::absolute_errors(matched, evaluation::Alignment::kSe3).rmse_m;
  accuracy.drift =
      evaluation::relative_errors(matched, {.lengths_m = {50.0, 100.0}, .step_rows = 10}).overall;
  return accuracy;
}

}  // namespace pago::app
