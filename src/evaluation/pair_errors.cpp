// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/pair_errors.hpp"

#include <cmath>

#include "matched_paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/motion.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

void check(const PairOptions& options) {
  if (!(options.delta > 0.0 && std::isfinite(options.delta)))
    throw Error("pair distance", format("%g is not greater than 0", options.delta));
  if (options.unit == PairOptions::Unit::kRows && options.delta != std::floor(options.delta))
    throw Error("pair distance", format("%g is not a whole number of rows", options.delta));
  if (!(options.tolerance > 0.0 && std::isfinite(options.tolerance)))
    throw Error("pair tolerance", format("%g is not greater than 0", options.tolerance));
}

Pairs pairs_by_row(std::size_t num_rows, const PairOptions& options) {
  const auto delta = static_cast<std::size_t>(options.delta);
  Pairs pairs;
  for (std::size_t i = 0; i + delta < num_rows; i += options.all_pairs ? 1 : delta)
    pairs.emplace_back(i, i + delta);
  return pairs;
}

Pairs chained_pairs(const std::vector<Eigen::Isometry3d>& path, double delta_m) {
  std::vector<std::size_t> crossings;
  double travelled_m = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) travelled_m += (path[i].translation() - path[i - 1].translation()).norm();
    if (travelled_m < delta_m) continue;
    crossings.push_back(i);
    travelled_m = 0.0;
  }
  Pairs pairs;
  for (std::size_t i = 1; i < crossings.size(); ++i) pairs.emplace_back(crossings[i - 1], crossings[i]);
  return pairs;
}

Pairs all_pairs(const std::vector<Eigen::Isometry3d>& path, double delta_m, double tolerance_m) {
  const std::vector<double> distance_m = distances_m(path);
  Pairs pairs;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const std::size_t j = closest_distance(distance_m, i + 1, distance_m[i] + delta_m);
    if (std::abs(distance_m[j] - distance_m[i] - delta_m) <= tolerance_m) pairs.emplace_back(i, j);
  }
  return pairs;
}

}  // namespace

Pairs evo_pairs(const std::vector<Eigen::Isometry3d>& path, const PairOptions& options) {
  check(options);
  if (options.unit == PairOptions::Unit::kRows) return pairs_by_row(path.size(), options);
  if (options.all_pairs) return all_pairs(path, options.delta, options.tolerance * options.delta);
  return chained_pairs(path, options.delta);
}

PairErrors pair_errors(const MatchedTrajectories& matched, const PairOptions& options) {
  const MatchedPaths paths = paths_of(matched);
  std::vector<double> translation_m, rotation_deg, point_distance_m;
  for (const auto& [i, j] : evo_pairs(options.pairs_from_truth ? paths.truth : paths.estimate, options)) {
    const Eigen::Isometry3d E =
        motion_error(paths.truth[i], paths.truth[j], paths.estimate[i], paths.estimate[j]);
    const auto distance_m = [i = i, j = j](const std::vector<Eigen::Isometry3d>& path) {
      return (path[j].translation() - path[i].translation()).norm();
    };
    translation_m.push_back(E.translation().norm());
    rotation_deg.push_back(log_so3(E.linear()).norm() * kDegPerRad);
    point_distance_m.push_back(std::abs(distance_m(paths.truth) - distance_m(paths.estimate)));
  }
  return {statistics_of(translation_m), statistics_of(rotation_deg), statistics_of(point_distance_m)};
}

}  // namespace pago::evaluation
