// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/sub_trajectories.hpp"

#include <cmath>

#include "matched_paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

void check(const SubTrajectoryOptions& options) {
  if (!(options.max_difference > 0.0 && std::isfinite(options.max_difference)))
    throw Error("sub-trajectories",
                format("the difference %g is not greater than 0", options.max_difference));
  for (const double part : options.parts)
    if (!(part > 0.0 && part <= 1.0))
      throw Error("sub-trajectories", format("%g is not a part of the path, in (0, 1]", part));
  for (const double length_m : options.lengths_m)
    if (!(length_m > 0.0 && std::isfinite(length_m)))
      throw Error("sub-trajectories", format("%g m is not a length greater than 0", length_m));
}

std::vector<double> chosen_lengths_m(const SubTrajectoryOptions& options, double path_length_m) {
  if (!options.lengths_m.empty()) return options.lengths_m;
  std::vector<double> lengths_m;
  for (const double part : options.parts) {
    const double length_m = std::trunc(100.0 * part * path_length_m) / 100.0;
    if (length_m > 0.0) lengths_m.push_back(length_m);
  }
  return lengths_m;
}

/// Errors of the sub-trajectories of one length, one entry each.
struct Lists {
  std::vector<double> translation_m, rotation_deg, yaw_deg, tilt_deg;
};

void add(Lists& lists, const MatchedPose& first, const MatchedPose& last) {
  const Eigen::Isometry3d E = motion_error(first.T_world_sensor_truth, last.T_world_sensor_truth,
                                           *first.T_world_sensor_estimate, *last.T_world_sensor_estimate);
  const Eigen::Matrix3d R_world_sensor = last.T_world_sensor_estimate->linear();
  const Eigen::Vector3d rpy_rad =
      roll_pitch_yaw_rad(R_world_sensor * E.linear() * R_world_sensor.transpose());
  lists.translation_m.push_back(E.translation().norm());
  lists.rotation_deg.push_back(log_so3(E.linear()).norm() * kDegPerRad);
  lists.yaw_deg.push_back(std::abs(rpy_rad.z()) * kDegPerRad);
  lists.tilt_deg.push_back(rpy_rad.head<2>().norm() * kDegPerRad);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

SubTrajectoryErrors errors_of(const Lists& lists, double length_m) {
  SubTrajectoryErrors errors;
  errors.length_m = length_m;
  errors.translation_m = statistics_of(lists.translation_m);
  errors.translation_percent = statistics_of(scaled(lists.translation_m, 100.0 / length_m));
  errors.rotation_deg = statistics_of(lists.rotation_deg);
  errors.rotation_deg_per_100m = statistics_of(scaled(lists.rotation_deg, 100.0 / length_m));
  errors.yaw_deg = statistics_of(lists.yaw_deg);
  errors.tilt_deg = statistics_of(lists.tilt_deg);
  return errors;
}

}  // namespace

std::vector<SubTrajectoryErrors> sub_trajectory_errors(const MatchedTrajectories& matched,
                                                       const SubTrajectoryOptions& options) {
  check(options);
  std::vector<SubTrajectoryErrors> all;
  const std::vector<double> distance_m = true_distances_m(matched);
  if (distance_m.empty()) return all;
  for (const double length_m : chosen_lengths_m(options, distance_m.back())) {
    Lists lists;
    for (std::size_t first = 0; first < distance_m.size(); ++first) {
      const std::size_t last = closest_distance(distance_m, first, distance_m[first] + length_m);
      const double difference_m = std::abs(distance_m[last] - (distance_m[first] + length_m));
      const MatchedPose &from = matched.poses[first], &to = matched.poses[last];
      if (difference_m < options.max_difference * length_m && from.T_world_sensor_estimate &&
          to.T_world_sensor_estimate)
        add(lists, from, to);
    }
    if (!lists.translation_m.empty()) all.push_back(errors_of(lists, length_m));
  }
  return all;
}

}  // namespace pago::evaluation
