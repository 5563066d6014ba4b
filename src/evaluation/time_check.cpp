// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "motions.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {
namespace {

constexpr int kStepsPerRow = 4;
constexpr int kMostRows = 5;
constexpr double kSmallestShiftRows = 0.2;
// Measured: at most 0.10 on KITTI 00 to 10 and on simulated drives as they should be, at least 0.41 with the
// truth half a sweep off. Over few rows chance gains more, up to 0.47 over 39 motions.
constexpr double kSmallestTimeGain = 0.2, kGainByChance = 3.2;

/// The truth at a row between two rows.
Eigen::Isometry3d truth_at(const MatchedTrajectories& matched, double row) {
  const auto before = std::min(static_cast<std::size_t>(row), matched.poses.size() - 2);
  return interpolate(matched.poses[before].T_world_sensor_truth,
                     matched.poses[before + 1].T_world_sensor_truth, row - static_cast<double>(before));
}

/// Against the truth `shift` rows later. The outermost rows are never used, so that every shift is judged by
/// the same motions of the estimate.
Misfit misfit_at(const MatchedTrajectories& matched, double shift, std::size_t& num_motions) {
  std::vector<MotionPair> pairs;
  for (std::size_t i = kMostRows; i + kMostRows + 1 < matched.poses.size(); ++i) {
    const MatchedPose &from = matched.poses[i], &to = matched.poses[i + 1];
    if (!from.T_world_sensor_estimate || !to.T_world_sensor_estimate) continue;
    const double row = static_cast<double>(i) + shift;
    pairs.push_back({motion_between(truth_at(matched, row), truth_at(matched, row + 1.0)),
                     motion_between(*from.T_world_sensor_estimate, *to.T_world_sensor_estimate)});
  }
  num_motions = pairs.size();
  return misfit_of(pairs);
}

/// Gains over no shift, from -kMostRows to kMostRows rows.
std::vector<double> gains_of(const MatchedTrajectories& matched) {
  std::size_t num_motions = 0;
  const Misfit unshifted = misfit_at(matched, 0.0, num_motions);
  std::vector<double> gains;
  for (int step = -kMostRows * kStepsPerRow; step <= kMostRows * kStepsPerRow; ++step)
    gains.push_back(gain(unshifted, misfit_at(matched, static_cast<double>(step) / kStepsPerRow, num_motions),
                         num_motions));
  return gains;
}

/// Top of the parabola through the best gain and its neighbours, in steps from the best one.
double refined(const std::vector<double>& gains, std::size_t best) {
  if (best == 0 || best + 1 == gains.size()) return 0.0;
  const double left = gains[best - 1], middle = gains[best], right = gains[best + 1];
  return 0.5 * (left - right) / (left - 2.0 * middle + right);
}

std::string what_it_is(double rows) {
  const double size = std::abs(rows);
  if (std::abs(size - 0.5) < 0.15)
    return "one file holds the poses of the sweeps' middles, the other those of their start or end";
  if (std::abs(size - 1.0) < 0.15)
    return "the rows are off by one, or one file holds the poses of the sweeps' starts and the other of "
           "their "
           "ends";
  if (std::abs(size - std::round(size)) < 0.15) return format("the rows are off by %.0f", std::round(size));
  return "the two clocks differ";
}

std::string remedy(double rows, double row_interval_s) {
  const bool is_instant = std::abs(rows) < 1.15 && std::abs(2.0 * rows - std::round(2.0 * rows)) < 0.3;
  std::string text =
      is_instant ? "State the instants of both files (start, mid, end)" : "Choose rows that belong together";
  return text + format("; by stamp, a time offset of %+.3f s.", rows * row_interval_s);
}

}  // namespace

std::optional<MixUp> find_time_shift(const MatchedTrajectories& matched, double row_interval_s) {
  if (matched.poses.size() < 4 * kMostRows) return std::nullopt;
  const std::vector<double> gains = gains_of(matched);
  // Interpolation smooths a noisy truth, which lets any shift look better, forth and back alike: what counts
  // is how much better it is than the opposite shift.
  const auto net = [&](std::size_t i) { return gains[i] - std::max(0.0, gains[gains.size() - 1 - i]); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < gains.size(); ++i)
    if (net(i) > net(best)) best = i;
  const double rows =
      (static_cast<double>(best) + refined(gains, best)) / kStepsPerRow - static_cast<double>(kMostRows);
  const double by_chance = kGainByChance / std::sqrt(static_cast<double>(matched.num_matched()));
  if (net(best) < std::max(kSmallestTimeGain, by_chance) || std::abs(rows) < kSmallestShiftRows)
    return std::nullopt;
  if (best == 0 || best + 1 == gains.size())
    return MixUp{MixUpKind::kTimeShift, "The estimate seems to hold for another time than the truth",
                 format("its motions fit the better the %s in the truth, as far as was looked: %d rows",
                        rows > 0.0 ? "later" : "earlier", kMostRows),
                 "Choose rows or stamps that belong together.", rows};
  return MixUp{MixUpKind::kTimeShift, "The estimate seems to hold for another time than the truth",
               format("its motions fit best %.2f rows (%.0f ms) %s in the truth, with %.0f %% less error; ",
                      std::abs(rows), 1e3 * std::abs(rows) * row_interval_s, rows > 0.0 ? "later" : "earlier",
                      100.0 * (1.0 - std::exp(-0.25 * gains[best]))) +
                   what_it_is(rows),
               remedy(rows, row_interval_s), rows};
}

}  // namespace pago::evaluation
