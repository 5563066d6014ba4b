// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/evaluation.hpp"

#include <algorithm>
#include <limits>

#include "matched_paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

void bring_to_sensor(Trajectory& truth, Trajectory& estimate, const EvaluationOptions& options) {
  const bool is_truth_camera = options.truth_frame == PoseFrame::kCamera;
  const bool is_estimate_camera = options.estimate_frame == PoseFrame::kCamera;
  if (is_truth_camera != is_estimate_camera && !options.T_camera_sensor)
    throw Error(is_truth_camera ? truth.name : estimate.name,
                "holds poses of the camera, the other file poses of the sensor",
                "give the calibration between them, KITTI's calib.txt");
  const Eigen::Isometry3d T_camera_sensor = options.T_camera_sensor.value_or(T_camera_sensor_axes());
  if (is_truth_camera && options.T_truth_sensor)
    throw Error(truth.name, "cannot hold poses of the camera and of another body at once");
  if (options.T_truth_sensor) body_to_sensor(truth, *options.T_truth_sensor);
  if (is_truth_camera) camera_to_sensor(truth, T_camera_sensor);
  if (is_estimate_camera) camera_to_sensor(estimate, T_camera_sensor);
}

FinalDrift final_drift_of(const MatchedPaths& paths) {
  const Eigen::Isometry3d true_motion = paths.truth.front().inverse() * paths.truth.back();
  const Eigen::Isometry3d estimated_motion = paths.estimate.front().inverse() * paths.estimate.back();
  const double length_m = distances_m(paths.truth).back();
  FinalDrift drift;
  drift.position_m = estimated_motion.translation() - true_motion.translation();
  drift.distance_m = drift.position_m.norm();
  drift.percent =
      length_m > 0.0 ? 100.0 * drift.distance_m / length_m : std::numeric_limits<double>::quiet_NaN();
  drift.rotation_rad = log_so3(true_motion.linear().transpose() * estimated_motion.linear()).norm();
  return drift;
}

std::vector<std::string> warnings_of(const Evaluation& e) {
  std::vector<std::string> warnings;
  if (e.num_matched < e.num_rows)
    warnings.push_back(
        format("%zu of %zu rows have no estimate; %zu segments that start or end there were skipped.",
               e.num_rows - e.num_matched, e.num_rows, e.relative.num_skipped));
  const double shortest_m = *std::min_element(e.lengths_m.begin(), e.lengths_m.end());
  if (e.relative.segments.empty() && e.truth_motion.path_length_m <= shortest_m)
    warnings.push_back(
        format("No relative error: the path of %.1f m is not longer than the shortest length, %g m; choose "
               "shorter lengths, for example 20,40,60.",
               e.truth_motion.path_length_m, shortest_m));
  for (const MixUp& mix_up : e.mix_ups) warnings.push_back(mix_up.sentence());
  return warnings;
}

}  // namespace

Evaluation evaluate(Trajectory truth, Trajectory estimate, const EvaluationOptions& options) {
  bring_to_sensor(truth, estimate, options);
  const MatchedTrajectories matched = match(truth, estimate, options.match);
  const MatchedPaths paths = paths_of(matched);
  if (paths.truth.empty()) throw Error(estimate.name, "has no pose for any of the chosen rows");

  Evaluation e;
  e.truth_name = truth.name;
  e.estimate_name = estimate.name;
  e.truth_poses = truth.poses.size();
  e.estimate_poses = estimate.poses.size();
  e.num_rows = matched.poses.size();
  e.num_matched = paths.truth.size();
  e.how = matched.how;
  e.lengths_m = options.segments.lengths_m;
  e.step_rows = options.segments.step_rows;
  e.truth_motion = motion_of(paths.truth);
  e.estimate_motion = motion_of(paths.estimate);
  e.relative = relative_errors(matched, options.segments);
  for (std::size_t i = 0; i < e.absolute.size(); ++i)
    e.absolute[i] = absolute_errors(matched, static_cast<Alignment>(i));
  e.sub_trajectories = sub_trajectory_errors(matched, options.sub_trajectories);
  e.pair_options = options.pairs;
  e.pairs = pair_errors(matched, options.pairs);
  e.final_drift = final_drift_of(paths);
  if (!estimate.motion_covariances.empty())
    e.consistency = consistency_of(matched, estimate.motion_covariances);
  e.course = course_of(matched, options.alignment);
  e.course_alignment = options.alignment;
  e.mix_ups = find_mix_ups(truth, estimate, options.match);
  e.warnings = matched.notes;
  for (std::string& warning : warnings_of(e)) e.warnings.push_back(std::move(warning));
  return e;
}

}  // namespace pago::evaluation
