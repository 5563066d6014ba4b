// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/pair_errors.hpp"

#include <cmath>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/motion.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<Eigen::Isometry3d> path_of(const Trajectory& trajectory) {
  std::vector<Eigen::Isometry3d> path;
  for (const StampedPose& pose : trajectory.poses) path.push_back(pose.T_world_sensor);
  return path;
}

PairErrors errors(const Trajectory& truth, const Trajectory& estimate, const PairOptions& options) {
  return pair_errors(by_row(truth, estimate), options);
}

TEST_CASE("chained pairs begin at the first crossing, not at the first pose", "[evaluation][pair_errors]") {
  const auto path = path_of(chain(planar(0.3, 0, 0), 14, "path"));
  // Crossings of 1 m: rows 4, 8, 12, each counted anew from the crossing before.
  CHECK(evo_pairs(path, {.delta = 1.0}) == Pairs{{4, 8}, {8, 12}});
  CHECK(evo_pairs(path, {.delta = 100.0}).empty());
  CHECK(evo_pairs({}, {.delta = 1.0}).empty());
}

TEST_CASE("pairs by rows are chained or start at every row", "[evaluation][pair_errors]") {
  const auto path = path_of(chain(planar(0.3, 0, 0), 9, "path"));
  CHECK(evo_pairs(path, {.unit = PairOptions::Unit::kRows, .delta = 4.0}) == Pairs{{0, 4}, {4, 8}});
  const Pairs all = evo_pairs(path, {.unit = PairOptions::Unit::kRows, .delta = 4.0, .all_pairs = true});
  CHECK(all == Pairs{{0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 8}, {5, 9}});
}

TEST_CASE("all pairs in metres are the closest within the tolerance", "[evaluation][pair_errors]") {
  const auto path = path_of(winding(3, 120, "path"));
  const std::vector<double> distance_m = distances_m(path);
  Pairs plain;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    std::size_t best = i + 1;
    for (std::size_t j = i + 1; j < path.size(); ++j)
      if (std::abs(distance_m[j] - distance_m[i] - 20.0) < std::abs(distance_m[best] - distance_m[i] - 20.0))
        best = j;
    if (std::abs(distance_m[best] - distance_m[i] - 20.0) <= 0.4) plain.emplace_back(i, best);
  }
  CHECK(plain.size() > 50);
  CHECK(evo_pairs(path, {.delta = 20.0, .all_pairs = true, .tolerance = 0.02}) == plain);
}

TEST_CASE("pairs are found along the estimate unless the truth is asked for", "[evaluation][pair_errors]") {
  const Trajectory truth = chain(planar(1.0, 0, 0), 100, "truth");
  const Trajectory estimate = chain(planar(2.0, 0, 0), 100, "estimate");
  // 20 m of the estimate are 10 rows, and off by 10 m; 20 m of the truth are 20 rows.
  const PairErrors along_estimate = errors(truth, estimate, {.delta = 20.0});
  CHECK(along_estimate.translation_m.count == 9);
  CHECK(along_estimate.translation_m.rmse == Approx(10.0));
  CHECK(along_estimate.point_distance_m.rmse == Approx(10.0));
  const PairErrors along_truth = errors(truth, estimate, {.delta = 20.0, .pairs_from_truth = true});
  CHECK(along_truth.translation_m.count == 4);
  CHECK(along_truth.translation_m.rmse == Approx(20.0));
}

TEST_CASE("a turn of one degree per row is one degree between neighbours", "[evaluation][pair_errors]") {
  const Trajectory truth = chain(planar(1.0, 0, 0), 50, "truth");
  const Trajectory estimate = chain(planar(1.0, 0, 0.017453292519943295), 50, "estimate");
  const PairErrors e = errors(truth, estimate, {.unit = PairOptions::Unit::kRows, .delta = 1.0});
  CHECK(e.rotation_deg.rmse == Approx(1.0));
  CHECK(e.rotation_deg.deviation == Approx(0.0).margin(1e-9));
  CHECK(e.point_distance_m.max < 1e-9);
}

TEST_CASE("pairs that make no sense are refused, paths without a pair have no error",
          "[evaluation][pair_errors]") {
  const Trajectory truth = chain(planar(1, 0, 0), 10, "truth");
  CHECK_THROWS_AS(errors(truth, truth, {.delta = 0.0}), pago::Error);
  CHECK_THROWS_AS(errors(truth, truth, {.unit = PairOptions::Unit::kRows, .delta = 1.5}), pago::Error);
  CHECK_THROWS_AS(errors(truth, truth, {.delta = 1.0, .all_pairs = true, .tolerance = 0.0}), pago::Error);
  CHECK(std::isnan(errors(truth, truth, {.delta = 100.0}).translation_m.rmse));
}

}  // namespace
