// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/relative_error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "matched_paths.hpp"
#include "no_value.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

void check(const SegmentOptions& options) {
  if (options.step_rows < 1) throw Error("step", "must be at least 1 row");
  if (!(options.row_interval_s > 0.0 && std::isfinite(options.row_interval_s)))
    throw Error("row interval", format("%g s is not greater than 0", options.row_interval_s));
  if (options.lengths_m.empty()) throw Error("lengths", "there is none");
  for (const double length_m : options.lengths_m)
    if (!(length_m > 0.0 && std::isfinite(length_m)))
      throw Error("lengths", format("%g m is not a length greater than 0", length_m));
}

double duration_s(const MatchedPose& first, const MatchedPose& last, double row_interval_s) {
  if (first.stamp_ns && last.stamp_ns) return static_cast<double>(*last.stamp_ns - *first.stamp_ns) * 1e-9;
  return static_cast<double>(last.row - first.row) * row_interval_s;
}

SegmentError segment_error(const MatchedPose& first, const MatchedPose& last, double length_m) {
  const Eigen::Isometry3d true_motion = first.T_world_sensor_truth.inverse() * last.T_world_sensor_truth;
  const Eigen::Isometry3d estimated_motion =
      first.T_world_sensor_estimate->inverse() * *last.T_world_sensor_estimate;
  const Eigen::Isometry3d E = estimated_motion.inverse() * true_motion;
  SegmentError error;
  error.length_m = length_m;
  error.translation = E.translation().norm() / length_m;
  error.rotation_rad_per_m = log_so3(E.linear()).norm() / length_m;
  error.translation_per_axis = E.translation() / length_m;
  error.rotation_rad_per_m_per_axis = roll_pitch_yaw_rad(E.linear()) / length_m;
  return error;
}

/// From `first` to the first pose beyond the length, if the path goes on that far.
void add_segment(RelativeErrors& errors,
                 const MatchedTrajectories& matched,
                 const std::vector<double>& distance_m,
                 std::size_t first,
                 double length_m,
                 double row_interval_s) {
  const auto start = distance_m.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = std::upper_bound(start, distance_m.end(), *start + length_m);
  if (end == distance_m.end()) return;
  const auto last = static_cast<std::size_t>(end - distance_m.begin());
  const MatchedPose &from = matched.poses[first], &to = matched.poses[last];
  if (!from.T_world_sensor_estimate || !to.T_world_sensor_estimate) {
    ++errors.num_skipped;
    return;
  }
  SegmentError& error = errors.segments.emplace_back(segment_error(from, to, length_m));
  error.first = first;
  error.last = last;
  error.speed_m_per_s = length_m / duration_s(from, to, row_interval_s);
}

DriftRates rates_where(const RelativeErrors& errors, const std::function<bool(const SegmentError&)>& is_in) {
  std::vector<SegmentError> segments;
  std::copy_if(errors.segments.begin(), errors.segments.end(), std::back_inserter(segments), is_in);
  return drift_rates(segments);
}

std::vector<DriftRates> rates_by_length(const RelativeErrors& errors, const std::vector<double>& lengths_m) {
  std::vector<DriftRates> rates;
  for (const double length_m : lengths_m) {
    rates.push_back(rates_where(errors, [&](const SegmentError& s) { return s.length_m == length_m; }));
    rates.back().length_m = length_m;
    if (rates.back().num_segments == 0) rates.pop_back();
  }
  return rates;
}

std::vector<DriftRates> rates_by_speed(const RelativeErrors& errors) {
  constexpr double kStep = 2.0, kHalfWidth = 2.0, kFastest = 100.0;
  constexpr std::size_t kFewest = 3;
  double fastest = 0.0;
  for (const SegmentError& segment : errors.segments)
    fastest = std::clamp(segment.speed_m_per_s, fastest, kFastest);
  std::vector<DriftRates> rates;
  for (double speed = kStep; speed < fastest + kHalfWidth; speed += kStep) {
    rates.push_back(rates_where(
        errors, [&](const SegmentError& s) { return std::abs(s.speed_m_per_s - speed) < kHalfWidth; }));
    rates.back().speed_m_per_s = speed;
    if (rates.back().num_segments < kFewest) rates.pop_back();
  }
  return rates;
}

}  // namespace

DriftRates drift_rates(const std::vector<SegmentError>& segments) {
  DriftRates rates;
  rates.num_segments = segments.size();
  for (const SegmentError& segment : segments) {
    rates.t_rel_percent += segment.translation;
    rates.r_rel_deg_per_100m += segment.rotation_rad_per_m;
    rates.axis_percent += segment.translation_per_axis.cwiseAbs();
    rates.axis_deg_per_100m += segment.rotation_rad_per_m_per_axis.cwiseAbs();
  }
  const double n = segments.empty() ? kNoValue : static_cast<double>(segments.size());
  rates.t_rel_percent *= 100.0 / n;
  rates.axis_percent *= 100.0 / n;
  rates.r_rel_deg_per_100m *= 100.0 * kDegPerRad / n;
  rates.axis_deg_per_100m *= 100.0 * kDegPerRad / n;
  return rates;
}

RelativeErrors relative_errors(const MatchedTrajectories& matched, const SegmentOptions& options) {
  check(options);
  const std::vector<double> distance_m = true_distances_m(matched);
  RelativeErrors errors;
  for (std::size_t first = 0; first < distance_m.size(); first += static_cast<std::size_t>(options.step_rows))
    for (const double length_m : options.lengths_m)
      add_segment(errors, matched, distance_m, first, length_m, options.row_interval_s);
  errors.overall = drift_rates(errors.segments);
  errors.by_length = rates_by_length(errors, options.lengths_m);
  errors.by_speed = rates_by_speed(errors);
  return errors;
}

}  // namespace pago::evaluation
