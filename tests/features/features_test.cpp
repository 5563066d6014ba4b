// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/features.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

#include "support/catch.hpp"
#include "support/street.hpp"

using namespace pago;
using namespace pago::features;

namespace {

Sweep street_sweep(double noise_m) {
  Sweep sweep(test::kStreetReturns);
  test::Street().scan(test::street_start(), Vector6d::Zero(), 0, noise_m, sweep);
  return sweep;
}

}  // namespace

TEST_CASE("on a street edges lie on corners and poles, planar points on ground and walls",
          "[features][stage]") {
  Sweep sweep = street_sweep(0.01);
  FeaturesStage stage(FeaturesConfig{}, test::kStreetReturns);
  stage.finish(sweep);
  const FeatureLists& lists = sweep.features;
  REQUIRE(lists.sharp_edges.size() > 50);
  REQUIRE(lists.edges.size() > lists.sharp_edges.size());
  REQUIRE(lists.flat_planars.size() > 500);
  REQUIRE(lists.planars.size() > 3000);

  std::size_t near_corner = 0;
  for (const std::uint32_t i : lists.sharp_edges) {
    REQUIRE(sweep.ground[i] == kNonGround);
    // Corners stand every 12 m in x; poles 3 m behind a corner on the left, 8 m on the right.
    const double x = static_cast<double>(sweep.x_m[i]);
    const auto off = [&](double at) { return std::abs(std::remainder(x - at, 12.0)); };
    if (std::min({off(0.0), off(3.0), off(8.0)}) < 0.4 || std::abs(x) > 60.0) ++near_corner;
  }
  INFO(near_corner << " of " << lists.sharp_edges.size());
  REQUIRE(10 * near_corner > 8 * lists.sharp_edges.size());

  std::size_t ground = 0;
  for (const std::uint32_t i : lists.flat_planars) ground += sweep.ground[i];
  REQUIRE(ground > 100);
  REQUIRE(ground < lists.flat_planars.size());
}

TEST_CASE("no sector gives more than its quota and no return is picked twice", "[features][stage]") {
  Sweep sweep = street_sweep(0.02);
  const FeaturesConfig config;
  FeaturesStage(config, test::kStreetReturns).finish(sweep);
  std::array<int, kNumRings> sharp{}, edges{}, flat{};
  for (const std::uint32_t i : sweep.features.sharp_edges) ++sharp[sweep.ring[i]];
  for (const std::uint32_t i : sweep.features.edges) ++edges[sweep.ring[i]];
  for (const std::uint32_t i : sweep.features.flat_planars) ++flat[sweep.ring[i]];
  for (std::size_t ring = 0; ring < kNumRings; ++ring) {
    REQUIRE(sharp[ring] <= config.sectors * config.sharp_edges_per_sector);
    REQUIRE(edges[ring] <= config.sectors * config.edges_per_sector);
    REQUIRE(flat[ring] <= 2 * config.sectors * config.flat_planars_per_sector);
  }
  const auto unique = [](const FixedVector<std::uint32_t>& list) {
    return std::set<std::uint32_t>(list.begin(), list.end()).size();
  };
  REQUIRE(unique(sweep.features.edges) == sweep.features.edges.size());
  REQUIRE(unique(sweep.features.planars) == sweep.features.planars.size());
  std::set<std::uint32_t> edge_set(sweep.features.edges.begin(), sweep.features.edges.end());
  for (const std::uint32_t i : sweep.features.planars) REQUIRE(edge_set.count(i) == 0);
}

// Drawn, not spaced out: how far one is from the next varies, how many there are does not.
TEST_CASE("targets are as many as their spacing along a ring asks for", "[features][stage]") {
  Sweep sweep = street_sweep(0.0);
  FeaturesConfig config;
  config.planar_spacing_m = 0.5;
  FeaturesStage(config, test::kStreetReturns).finish(sweep);
  double expected = 0.0;
  const double per_range = 2.0 * std::numbers::pi / (sweep.header.num_columns * config.planar_spacing_m);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const double range_m = static_cast<double>(std::hypot(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]));
    expected += std::min(1.0, range_m * per_range);
  }
  REQUIRE(static_cast<double>(sweep.features.planars.size()) == Approx(expected).epsilon(0.15));
}

TEST_CASE("planar points to register come from the ground alone where that is asked for",
          "[features][stage]") {
  Sweep sweep = street_sweep(0.01);
  FeaturesConfig config;
  config.planar_source = PlanarSource::kGroundOnly;
  FeaturesStage(config, test::kStreetReturns).finish(sweep);
  REQUIRE(sweep.features.flat_planars.size() > 100);
  for (const std::uint32_t i : sweep.features.flat_planars) REQUIRE(sweep.ground[i] == kGround);
}

TEST_CASE("without spacing all that is no edge is a target, with a quota the flattest are",
          "[features][stage]") {
  FeaturesConfig config;
  config.planar_spacing_m = 0.0;
  Sweep all = street_sweep(0.01), few = street_sweep(0.01);
  FeaturesStage(config, test::kStreetReturns).finish(all);
  std::size_t usable = 0;
  for (std::uint32_t i = 0; i < all.size; ++i) usable += all.cluster[i] != kClutter ? 1U : 0U;
  REQUIRE(all.features.planars.size() + all.features.edges.size() == usable);
  config.planars_per_sector = 80;
  FeaturesStage(config, test::kStreetReturns).finish(few);
  REQUIRE(few.features.planars.size() > 10'000);
  std::array<std::size_t, kNumRings> per_ring{};
  for (const std::uint32_t i : few.features.planars) ++per_ring[few.ring[i]];
  for (const std::size_t n : per_ring) REQUIRE(n <= 80 * 6);
}

TEST_CASE("edges and planars come row by row, and the rows are told", "[features][stage]") {
  Sweep sweep = street_sweep(0.01);
  FeaturesConfig config;
  config.planars_per_sector = GENERATE(0, 80);
  FeaturesStage(config, test::kStreetReturns).finish(sweep);
  const FeatureLists& lists = sweep.features;
  REQUIRE(lists.edge_rows[kNumRings] == lists.edges.size());
  REQUIRE(lists.planar_rows[kNumRings] == lists.planars.size());
  for (std::size_t row = 0; row < kNumRings; ++row) {
    for (std::uint32_t n = lists.edge_rows[row]; n < lists.edge_rows[row + 1]; ++n)
      REQUIRE(sweep.ring[lists.edges[n]] == row);
    for (std::uint32_t n = lists.planar_rows[row]; n < lists.planar_rows[row + 1]; ++n)
      REQUIRE(sweep.ring[lists.planars[n]] == row);
  }
}

TEST_CASE("ground can be taken from every fifth column only", "[features][stage]") {
  FeaturesConfig config;
  config.planar_spacing_m = 0.0;
  config.ground_every_columns = 5;
  Sweep sweep = street_sweep(0.01);
  FeaturesStage(config, test::kStreetReturns).finish(sweep);
  std::size_t ground = 0, others = 0;
  for (const std::uint32_t i : sweep.features.planars) {
    if (sweep.ground[i] != kGround) others += sweep.column[i] % 5 != 0 ? 1U : 0U;
    if (sweep.ground[i] != kGround || sweep.column[i] <= 5 || sweep.column[i] >= 1795) continue;
    ++ground;
    REQUIRE(sweep.column[i] % 5 == 0);
  }
  REQUIRE(ground > 1000);
  REQUIRE(others > 1000);
}

TEST_CASE("of segments too small to trust every fifth column of the upper rows is kept apart",
          "[features][stage]") {
  FeaturesConfig config;
  config.clustering.min_points = config.clustering.min_points_tall = 100'000;  // nothing is trusted
  Sweep none = street_sweep(0.01);
  FeaturesStage(config, test::kStreetReturns).finish(none);
  REQUIRE(none.features.outliers.empty());
  config.outlier_every_columns = 5;
  config.outliers_above_row = 55;
  Sweep some = street_sweep(0.01);
  FeaturesStage(config, test::kStreetReturns).finish(some);
  REQUIRE(some.features.outliers.size() > 100);
  for (const std::uint32_t i : some.features.outliers) {
    REQUIRE(some.cluster[i] == kClutter);
    REQUIRE(some.column[i] % 5 == 0);
    REQUIRE(some.ring[i] > 55);
  }
}

TEST_CASE("in the uniform grid some returns have no pixel of their own", "[features][stage]") {
  FeaturesConfig config;
  config.planar_spacing_m = 0.0;
  Sweep ring = street_sweep(0.01), uniform = street_sweep(0.01);
  FeaturesStage(config, test::kStreetReturns).finish(ring);
  config.projection = Projection::kUniform;
  config.grid.row_step_deg = 0.5;
  FeaturesStage(config, test::kStreetReturns).finish(uniform);
  REQUIRE(uniform.features.planars.size() > 10'000);
  REQUIRE(10 * uniform.features.planars.size() < 9 * ring.features.planars.size());
}

TEST_CASE("empty, single-return and all-ground sweeps give no edges", "[features][stage]") {
  FeaturesStage stage(FeaturesConfig{}, test::kStreetReturns);
  Sweep empty(10);
  stage.finish(empty);
  REQUIRE(empty.features.edges.empty());

  Sweep sweep = street_sweep(0.01);
  std::fill_n(sweep.ground.data(), sweep.size, kGround);
  stage.finish(sweep);
  REQUIRE(sweep.features.edges.empty());
  REQUIRE(sweep.features.flat_planars.size() > 100);
}

TEST_CASE("the same sweep gives the same features twice", "[features][stage]") {
  FeaturesStage stage(FeaturesConfig{}, test::kStreetReturns);
  Sweep a = street_sweep(0.02), b = street_sweep(0.02);
  stage.finish(a);
  stage.finish(b);
  REQUIRE(a.features.edges.size() == b.features.edges.size());
  REQUIRE(std::memcmp(a.features.edges.begin(), b.features.edges.begin(), a.features.edges.size() * 4) == 0);
  REQUIRE(a.features.planars.size() == b.features.planars.size());
  REQUIRE(std::memcmp(a.features.planars.begin(), b.features.planars.begin(),
                      a.features.planars.size() * 4) == 0);
}
