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
  return stamp_ns - *before->stamp_ns < *after->stamp_ns - stamp_ns ? *before : *after;
}

std::int64_t apart_ns(const StampedPose& a, const StampedPose& b) {
  return std::abs(*a.stamp_ns - *b.stamp_ns);
}

/// Of a dense truth, at a stamp between two of its own; nothing beyond either end or in a gap of it.
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

/// A pose of the estimate belongs to a truth row that it is nearest to, and to no other.
std::vector<MatchedPose> on_truth(const Trajectory& truth,
                                  const Trajectory& estimate,
                                  const MatchOptions& options) {
  std::vector<MatchedPose> poses;
  std::optional<std::size_t> taken;
  for (const StampedPose& pose : truth.poses) {
    if (!is_chosen(pose, options)) continue;
    MatchedPose& matched = poses.emplace_back();
    matched.row = pose.row;
    matched.stamp_ns = pose.stamp_ns;
    matched.T_world_sensor_truth = pose.T_world_sensor;
    const StampedPose& candidate = nearest(estimate.poses, *pose.stamp_ns);
    const std::int64_t distance_ns = apart_ns(candidate, pose);
    const bool is_of_another = distance_ns > apart_ns(candidate, nearest(truth.poses, *candidate.stamp_ns));
    if (is_of_another || taken == candidate.row || distance_ns > ns_of(options.max_difference_s)) continue;
    matched.T_world_sensor_estimate = candidate.T_world_sensor;
    matched.estimate_row = *(taken = candidate.row);
  }
  return poses;
}

/// Rows of the estimate without truth near them cannot be scored and are left out.
std::vector<MatchedPose> on_estimate(const Trajectory& truth,
                                     const Trajectory& estimate,
                                     const MatchOptions& options) {
  std::vector<MatchedPose> poses;
  for (const StampedPose& pose : estimate.poses) {
    if (!is_chosen(pose, options)) continue;
    const auto found = pose_at(truth.poses, *pose.stamp_ns, ns_of(options.max_difference_s));
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

/// What rows of the estimate as the base would hide.
std::vector<std::string> notes_on(const Trajectory& estimate,
                                  const MatchOptions& options,
                                  std::size_t num_scored) {
  std::vector<std::string> notes;
  const auto chosen = std::count_if(estimate.poses.begin(), estimate.poses.end(),
                                    [&](const StampedPose& pose) { return is_chosen(pose, options); });
  if (static_cast<std::size_t>(chosen) > num_scored)
    notes.push_back(format("%zu of %zu poses have no truth near them and are left out.",
                           static_cast<std::size_t>(chosen) - num_scored, static_cast<std::size_t>(chosen)));
  const std::int64_t usual_ns = median_interval_ns(estimate.poses);
  std::int64_t num_missing = 0, longest_ns = 0;
  for (std::size_t i = 1; usual_ns > 0 && i < estimate.poses.size(); ++i) {
    const std::int64_t interval_ns = apart_ns(estimate.poses[i], estimate.poses[i - 1]);
    num_missing += std::max<std::int64_t>(0, (interval_ns + usual_ns / 2) / usual_ns - 1);
    longest_ns = std::max(longest_ns, interval_ns);
  }
  if (num_missing > 0)
    notes.push_back(
        format("By its stamps the estimate lacks about %lld poses, for at most %.2f s; nothing "
               "is scored there, and rows count on as if there were none missing.",
               static_cast<long long>(num_missing), static_cast<double>(longest_ns) * 1e-9));
  return notes;
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
      throw Error(trajectory->name, "has no stamps to match by",
                  "KITTI files need a times file for that: --truth-times, --estimate-times");
  if (options.instant_shift_rows != 0.0)
    throw Error(estimate_as_given.name, "is matched by stamps, which say at which instant its poses hold",
                "start, mid and end are for matching by row; by stamp give a time offset");
  const Trajectory estimate = on_clock_of_truth(estimate_as_given, options.time_offset_s);
  const bool is_truth_denser = 2 * median_interval_ns(truth.poses) < median_interval_ns(estimate.poses);
  const bool is_on_estimate = options.interpolates_truth || is_truth_denser;
  MatchedTrajectories matched;
  matched.poses = is_on_estimate ? on_estimate(truth, estimate, options) : on_truth(truth, estimate, options);
  matched.how = format("by stamp within %.3f s%s", options.max_difference_s,
                       is_on_estimate ? ", truth interpolated" : "");
  if (options.time_offset_s != 0.0) matched.how += format(", offset %+.3f s", options.time_offset_s);
  if (matched.num_matched() == 0) refuse_clocks(truth, estimate, options.max_difference_s);
  if (is_on_estimate) matched.notes = notes_on(estimate, options, matched.poses.size());
  return matched;
}

}  // namespace

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
