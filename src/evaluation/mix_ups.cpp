// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/mix_ups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motions.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/motion.hpp"
#include "pago/evaluation/statistics.hpp"

namespace pago::evaluation {
namespace {

constexpr std::size_t kFewestMotions = 20;
constexpr double kShortestPath_m = 5.0;

using Poses = std::vector<StampedPose>;

double path_length_m(const Poses& poses) {
  std::vector<Eigen::Isometry3d> path;
  for (const StampedPose& pose : poses) path.push_back(pose.T_world_sensor);
  return motion_of(path).path_length_m;
}

/// The rows as they would be, had they been sorted as numbers, not as words.
Poses sorted_as_numbers(const Poses& poses) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < poses.size(); ++i) names.push_back(std::to_string(i));
  std::sort(names.begin(), names.end());
  Poses sorted = poses;
  for (std::size_t i = 0; i < poses.size(); ++i)
    sorted[std::stoul(names[i])].T_world_sensor = poses[i].T_world_sensor;
  return sorted;
}

/// Rows in the wrong order make jumps, so the path is longer.
std::optional<MixUp> find_unsorted(const Trajectory& trajectory) {
  const double given_m = path_length_m(trajectory.poses);
  const double sorted_m = path_length_m(sorted_as_numbers(trajectory.poses));
  if (given_m < kShortestPath_m || sorted_m > 0.5 * given_m) return std::nullopt;
  return MixUp{MixUpKind::kUnsorted,
               "The rows of " + trajectory.name + " seem to be in the order of words (0, 1, 10, 100, 2, ...)",
               format("its path is %.1f m long as it stands and %.1f m with the rows in the order of numbers",
                      given_m, sorted_m),
               "Write the poses in the order of their numbers.", given_m / sorted_m};
}

Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d flip = Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal();
  Eigen::Isometry3d M = Eigen::Isometry3d::Identity();
  M.linear() = flip * T.linear() * flip;
  M.translation() = flip * T.translation();
  return M;
}

/// qw qx qy qz as it was read: x y z w.
Eigen::Isometry3d with_w_first(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond read(T.linear());
  Eigen::Isometry3d M = T;
  M.linear() = Eigen::Quaterniond(read.x(), read.y(), read.z(), read.w()).toRotationMatrix();
  return M;
}

template <typename Change>
Trajectory changed(Trajectory trajectory, Change change) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_sensor = change(pose.T_world_sensor);
  return trajectory;
}

Trajectory reversed(const Trajectory& trajectory) {
  Trajectory back = trajectory;
  for (std::size_t i = 0; i < back.poses.size(); ++i)
    back.poses[i].T_world_sensor = trajectory.poses[back.poses.size() - 1 - i].T_world_sensor;
  return back;
}

/// What a typical motion is off by, with 10 m for 1 rad.
double typical_error_m(const std::vector<MotionPair>& pairs) {
  std::vector<double> errors;
  for (const auto& [truth, estimate] : pairs)
    errors.push_back((truth.translation_m - estimate.translation_m).norm() +
                     10.0 * (truth.rotation_rad - estimate.rotation_rad).norm());
  return statistics_of(errors).median;
}

double typical_step_m(const std::vector<MotionPair>& pairs) {
  std::vector<double> steps;
  for (const MotionPair& pair : pairs) steps.push_back(pair.truth.translation_m.norm());
  return statistics_of(steps).median;
}

struct Hypothesis {
  MixUpKind kind;
  const char* finding;
  const char* remedy;
  Trajectory estimate;
};

std::vector<Hypothesis> hypotheses(const Trajectory& estimate) {
  return {
      {MixUpKind::kInverted, "The estimate seems to hold T_sensor_world, the inverse of its poses",
       "Invert them.", changed(estimate, [](const auto& T) { return T.inverse(); })},
      {MixUpKind::kQuaternionOrder, "The estimate's quaternions seem to begin with qw",
       "TUM files have qx qy qz qw.", changed(estimate, with_w_first)},
      {MixUpKind::kMirrored, "The estimate seems to be mirrored: it turns right where the truth turns left",
       "Check the handedness of its axes and which way the head turns.", changed(estimate, mirrored)},
      {MixUpKind::kReversed, "The estimate's rows seem to begin with the last pose", "Turn their order.",
       reversed(estimate)}};
}

/// The change of the whole file that lets most of the error vanish, if there is one.
std::optional<MixUp> find_changed(const Trajectory& truth,
                                  const Trajectory& estimate,
                                  const MatchOptions& options,
                                  const std::vector<MotionPair>& pairs) {
  const double given_m = typical_error_m(pairs);
  if (given_m < 0.02 * typical_step_m(pairs)) return std::nullopt;
  double best_m = 0.2 * given_m;
  std::optional<MixUp> best;
  for (const Hypothesis& h : hypotheses(estimate)) {
    const double error_m = typical_error_m(motion_pairs(match(truth, h.estimate, options)));
    if (!(error_m < best_m)) continue;
    best_m = error_m;
    best = MixUp{
        h.kind, h.finding,
        format("its motions are off by %.3f m (and 0.1 rad counted as 1 m) as given, by %.3f m otherwise",
               given_m, error_m),
        h.remedy, given_m / error_m};
  }
  return best;
}

std::optional<MixUp> find_scale(const std::vector<MotionPair>& pairs) {
  constexpr double kMost = 1.2, kMostSpread = 0.1;
  std::vector<double> ratios;
  const double step_m = typical_step_m(pairs);
  for (const auto& [truth, estimate] : pairs)
    if (truth.translation_m.norm() > 0.5 * step_m)
      ratios.push_back(estimate.translation_m.norm() / truth.translation_m.norm());
  const double ratio = statistics_of(ratios).median;
  if (!(ratio > kMost || ratio < 1.0 / kMost)) return std::nullopt;
  // A unit changes all motions alike; an odometry that is lost does not.
  for (double& r : ratios) r = std::abs(r / ratio - 1.0);
  if (statistics_of(ratios).median > kMostSpread) return std::nullopt;
  return MixUp{MixUpKind::kScale, "The estimate seems to be in another unit of length than the truth",
               format("its motions are typically %.4g times as long", ratio), "Both files must be in metres.",
               ratio};
}

/// Both files in the camera's axes agree with each other, but what is said of z, roll and yaw is of other
/// axes.
std::optional<MixUp> find_camera_axes(const std::vector<MotionPair>& pairs) {
  constexpr double kMostly = 0.9;
  Eigen::Vector3d truth = Eigen::Vector3d::Zero(), estimate = Eigen::Vector3d::Zero();
  for (const MotionPair& pair : pairs)
    truth += pair.truth.translation_m, estimate += pair.estimate.translation_m;
  const double truth_share = truth.z() / truth.norm(), estimate_share = estimate.z() / estimate.norm();
  if (!(truth_share > kMostly && estimate_share > kMostly)) return std::nullopt;
  return MixUp{MixUpKind::kCameraFrame,
               "Both files seem to hold poses of KITTI's camera, which looks along z",
               format("%.0f %% of the way is along z, so that figures of single axes are of the camera's",
                      100.0 * truth_share),
               "For those of the sensor: --truth-frame camera --estimate-frame camera.", 90.0};
}

double row_interval_s(const MatchedTrajectories& matched) {
  const MatchedPose &first = matched.poses.front(), &last = matched.poses.back();
  constexpr double kTenHz = 0.1;
  if (!first.stamp_ns || !last.stamp_ns) return kTenHz;
  return static_cast<double>(*last.stamp_ns - *first.stamp_ns) * 1e-9 /
         static_cast<double>(matched.poses.size() - 1);
}

}  // namespace

std::vector<MixUp> find_mix_ups(const Trajectory& truth,
                                const Trajectory& estimate,
                                const MatchOptions& options) {
  std::vector<MixUp> found;
  for (const Trajectory* trajectory : {&truth, &estimate})
    if (trajectory->poses.size() > kFewestMotions)
      if (auto unsorted = find_unsorted(*trajectory)) found.push_back(*unsorted);
  const MatchedTrajectories matched = match(truth, estimate, options);
  const std::vector<MotionPair> pairs = motion_pairs(matched);
  double travelled_m = 0.0;
  for (const MotionPair& pair : pairs) travelled_m += pair.truth.translation_m.norm();
  if (!found.empty() || pairs.size() < kFewestMotions || travelled_m < kShortestPath_m) return found;

  // From the coarsest mistake to the finest: the next check would only see the last one's traces.
  if (auto change = find_changed(truth, estimate, options, pairs)) return {*change};
  if (auto scale = find_scale(pairs)) return {*scale};
  found = find_body_mix_ups(pairs);
  if (found.empty())
    if (auto shift = find_time_shift(matched, row_interval_s(matched))) found.push_back(*shift);
  if (found.empty())
    if (auto axes = find_camera_axes(pairs)) found.push_back(*axes);
  return found;
}

}  // namespace pago::evaluation
