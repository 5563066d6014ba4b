// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/association.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {
namespace {

using Poses = std::vector<StampedPose>;

std::int64_t ns_of(double seconds) {
  return std::llround(seconds * 1e9);
}

std::string count_of(const Trajectory& trajectory) {
  return trajectory.name + " has " + std::to_string(trajectory.poses.size()) + " poses";
}

RowRange chosen_rows(const Trajectory& truth, const Trajectory& estimate, const MatchOptions& options) {
  const std::size_t num_truth = truth.poses.size(), num_estimate = estimate.poses.size();
  if (!options.rows) {
    if (num_truth != num_estimate)
      throw Error(estimate.name, "has " + std::to_string(num_estimate) + " poses, " + count_of(truth),
                  "rows are matched by number: choose the rows A-B that belong together, or use stamps");
    return {0, num_truth - 1};
  }
  if (options.rows->last >= std::min(num_truth, num_estimate))
    throw Error(num_truth < num_estimate ? truth.name : estimate.name,
                "has no row " + std::to_string(options.rows->last),
                count_of(truth) + ", " + count_of(estimate) + ", rows count from 0");
  return *options.rows;
}

/// Between two rows with constant velocity and turn rate; nothing beyond either end.
std::optional<Eigen::Isometry3d> pose_at_row(const Poses& poses, double row) {
  const double before = std::floor(row);
  if (before < 0.0 || row > static_cast<double>(poses.size() - 1)) return std::nullopt;
  const auto first = static_cast<std::size_t>(before);
  if (row == before) return poses[first].T_world_sensor;
  return interpolate(poses[first].T_world_sensor, poses[first + 1].T_world_sensor, row - before);
}

MatchedTrajectories match_rows(const Trajectory& truth,
                               const Trajectory& estimate,
                               const MatchOptions& options) {
  const RowRange rows = chosen_rows(truth, estimate, options);
  const double shift = options.instant_shift_rows;
  MatchedTrajectories matched{.poses = {}, .how = "by row"};
  if (shift != 0.0) matched.how += format(", truth carried on by %+g rows", shift);
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    const auto T_truth = pose_at_row(truth.poses, static_cast<double>(row) + shift);
    const StampedPose& pose = estimate.poses[row];
    if (T_truth) matched.poses.push_back({row, pose.stamp_ns, *T_truth, pose.T_world_sensor, row});
  }
  return matched;
}

/// The first pose not before a stamp.
Poses::const_iterator not_before(const Poses& poses, std::int64_t stamp_ns) {
  return std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                          [](const StampedPose& pose, std::int64_t stamp) { return *pose.stamp_ns < stamp; });
}

const StampedPose& nearest(const Poses& poses, std::int64_t stamp_ns) {
  const auto after = not_before(poses, stamp_ns);
  if (after == poses.end()) return poses.back();
  if (after == poses.begin()) return *after;
  const auto before = std::prev(after);
  return stamp_ns - *before->stamp_ns <= *after->stamp_ns - stamp_ns ? *before : *after;
}

std::optional<Eigen::Isometry3d> pose_near(const Poses& poses, std::int64_t stamp_ns, std::int64_t max_ns) {
  const StampedPose& pose = nearest(poses, stamp_ns);
  if (std::abs(*pose.stamp_ns - stamp_ns) > max_ns) return std::nullopt;
  return pose.T_world_sensor;
}

std::optional<Eigen::Isometry3d> pose_at(const Poses& poses, std::int64_t stamp_ns, std::int64_t max_ns) {
  const auto after = not_before(poses, stamp_ns);
  if (after == poses.end() || std::abs(*nearest(poses, stamp_ns).stamp_ns - stamp_ns) > max_ns)
    return std::nullopt;
  if (*after->stamp_ns == stamp_ns) return after->T_world_sensor;
  if (after == poses.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double fraction = static_cast<double>(stamp_ns - *before->stamp_ns) /
                          static_cast<double>(*after->stamp_ns - *before->stamp_ns);
  return interpolate_straight(before->T_world_sensor, after->T_world_sensor, fraction);
}

bool is_chosen(const StampedPose& pose, const MatchOptions& options) {
  return !options.rows || (pose.row >= options.rows->first && pose.row <= options.rows->last);
}

/// A pose of the estimate belongs to the truth row that it is nearest to, and to no other.
std::vector<MatchedPose> on_truth(const Trajectory& truth,
                                  const Trajectory& estimate,
                                  const MatchOptions& options) {
  std::vector<MatchedPose> poses;
  for (const StampedPose& pose : truth.poses) {
    if (!is_chosen(pose, options)) continue;
    MatchedPose& matched = poses.emplace_back();
    matched.row = pose.row;
    matched.stamp_ns = pose.stamp_ns;
    matched.T_world_sensor_truth = pose.T_world_sensor;
    const StampedPose& candidate = nearest(estimate.poses, *pose.stamp_ns);
    if (nearest(truth.poses, *candidate.stamp_ns).row != pose.row) continue;
    matched.T_world_sensor_estimate =
        pose_near(estimate.poses, *pose.stamp_ns, ns_of(options.max_difference_s));
    matched.estimate_row = candidate.row;
  }
  return poses;
}

/// Rows of the estimate without truth near them cannot be scored and are left out.
std::vector<MatchedPose> on_estimate(const Trajectory& truth,
                                     const Trajectory& estimate,
                                     const MatchOptions& options) {
  std::vector<MatchedPose> poses;
  const auto truth_at = options.interpolates_truth ? pose_at : pose_near;
  for (const StampedPose& pose : estimate.poses) {
    if (!is_chosen(pose, options)) continue;
    const auto found = truth_at(truth.poses, *pose.stamp_ns, ns_of(options.max_difference_s));
    if (found) poses.push_back({pose.row, pose.stamp_ns, *found, pose.T_world_sensor, pose.row});
  }
  return poses;
}

std::int64_t median_interval_ns(const Poses& poses) {
  if (poses.size() < 2) return 0;
  std::vector<std::int64_t> intervals(poses.size() - 1);
  for (std::size_t i = 0; i < intervals.size(); ++i)
    intervals[i] = *poses[i + 1].stamp_ns - *poses[i].stamp_ns;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

std::string span_of(const Trajectory& trajectory) {
  return format("%.3f to %.3f s", static_cast<double>(*trajectory.poses.front().stamp_ns) * 1e-9,
                static_cast<double>(*trajectory.poses.back().stamp_ns) * 1e-9);
}

/// The estimate on the truth's clock.
Trajectory on_clock_of_truth(const Trajectory& estimate, double offset_s) {
  Trajectory shifted = estimate;
  for (StampedPose& pose : shifted.poses) *pose.stamp_ns += ns_of(offset_s);
  return shifted;
}

[[noreturn]] void refuse_clocks(const Trajectory& truth,
                                const Trajectory& estimate,
                                double max_difference_s) {
  const double offset_s =
      static_cast<double>(*truth.poses.front().stamp_ns - *estimate.poses.front().stamp_ns) * 1e-9;
  throw Error(estimate.name, format("no stamp within %.3f s of one of ", max_difference_s) + truth.name,
              "truth runs from " + span_of(truth) + ", the estimate from " + span_of(estimate) +
                  format("; a time offset of %.3f s lets both begin together", offset_s));
}

MatchedTrajectories match_stamps(const Trajectory& truth,
                                 const Trajectory& estimate_as_given,
                                 const MatchOptions& options) {
  for (const Trajectory* trajectory : {&truth, &estimate_as_given})
    if (!trajectory->has_stamps())
      throw Error(trajectory->name, "has no stamps to match by", "KITTI files need a times file for that");
  if (options.instant_shift_rows != 0.0)
    throw Error(estimate_as_given.name, "is matched by stamps, which say at which instant its poses hold",
                "start, mid and end are for matching by row; by stamp give a time offset");
  const Trajectory estimate = on_clock_of_truth(estimate_as_given, options.time_offset_s);
  const bool is_truth_denser = 2 * median_interval_ns(truth.poses) < median_interval_ns(estimate.poses);
  const bool is_on_estimate = options.interpolates_truth || is_truth_denser;
  MatchedTrajectories matched;
  matched.poses = is_on_estimate ? on_estimate(truth, estimate, options) : on_truth(truth, estimate, options);
  matched.how = format("by stamp within %.3f s%s", options.max_difference_s,
                       options.interpolates_truth ? ", truth interpolated" : "");
  if (options.time_offset_s != 0.0) matched.how += format(", offset %+.3f s", options.time_offset_s);
  if (matched.num_matched() == 0) refuse_clocks(truth, estimate, options.max_difference_s);
  return matched;
}

}  // namespace

double parse_instant(std::string_view word) {
  if (word == "start") return 0.0;
  if (word == "mid") return 0.5;
  if (word == "end") return 1.0;
  throw Error("instant", "\"" + std::string(word) + "\" is not start, mid or end");
}

RowRange parse_row_range(std::string_view text) {
  RowRange range;
  const char* const end = text.data() + text.size();
  const auto [dash, fault_a] = std::from_chars(text.data(), end, range.first);
  const bool has_dash = fault_a == std::errc{} && dash != end && *dash == '-';
  const auto [stop, fault_b] = std::from_chars(has_dash ? dash + 1 : end, end, range.last);
  if (!has_dash || fault_b != std::errc{} || stop != end || range.first > range.last)
    throw Error("rows", "\"" + std::string(text) + "\" is not a range", "give first-last, for example 0-152");
  return range;
}

std::size_t MatchedTrajectories::num_matched() const noexcept {
  return static_cast<std::size_t>(std::count_if(poses.begin(), poses.end(), [](const MatchedPose& pose) {
    return pose.T_world_sensor_estimate.has_value();
  }));
}

MatchedTrajectories match(const Trajectory& truth, const Trajectory& estimate, const MatchOptions& options) {
  for (const Trajectory* trajectory : {&truth, &estimate})
    if (trajectory->poses.empty()) throw Error(trajectory->name, "holds no pose");
  if (!(std::abs(options.instant_shift_rows) <= 1.0))
    throw Error("instant", format("%g rows is more than a sweep", options.instant_shift_rows));
  const bool is_by_stamp =
      options.matching == Matching::kStamp ||
      (options.matching == Matching::kAuto && truth.has_stamps() && estimate.has_stamps());
  return is_by_stamp ? match_stamps(truth, estimate, options) : match_rows(truth, estimate, options);
}

}  // namespace pago::evaluation
