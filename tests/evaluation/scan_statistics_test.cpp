// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/scan_statistics.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "support/catch.hpp"
#include "support/scene.hpp"

namespace {

using namespace pago;
using namespace pago::evaluation;
using namespace pago::test;
using Catch::Matchers::Contains;

constexpr std::uint32_t kMostReturns = kNumRings * 2208;

/// Of one scan, with the true ground mask.
Sweep sweep_of(const Scene& scene, const ScanOptions& options = {}) {
  Sweep sweep(kMostReturns);
  const std::vector<std::uint8_t> truth = scene.scan(sweep, options);
  std::ranges::copy(truth, sweep.ground.begin());
  return sweep;
}

/// A wall ahead, taller than the sensor sees, on level ground.
Scene wall_ahead() {
  Scene scene;
  scene.level_ground().box({15, -40, -1}, {16, 40, 30});
  return scene;
}

void lose(Sweep& sweep, double share, std::uint8_t surface) {
  std::mt19937 random(3);
  std::bernoulli_distribution is_lost(share);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    if (sweep.ground[i] == surface && is_lost(random))
      sweep.range_image.at(sweep.ring[i], sweep.column[i]) = RangeImage::kEmpty;
}

double dropout_at(const ScanStatistics& statistics, double incidence_deg) {
  return dropout_percent(statistics.surfaces[kIncidenceBins.of(incidence_deg)]);
}

/// A square of a plane, with noise across it.
Cloud floor_of(double height_m, double noise_m, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  std::normal_distribution<double> noise(height_m, noise_m);
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i)
    cloud.push_back(Eigen::Vector3d(place(random), place(random), noise(random)).cast<float>());
  return cloud;
}

TEST_CASE("returns are counted by ring, range and ground", "[evaluation][scan]") {
  Sweep sweep = sweep_of(wall_ahead());
  sweep.x_m[0] = sweep.y_m[0] = sweep.z_m[0] = 0.0F;  // no return
  ScanStatistics statistics;
  add_returns(sweep, statistics);
  add_returns(sweep, statistics);
  CHECK(statistics.sweeps == 2);
  CHECK(statistics.returns == 2U * (sweep.size - 1));
  CHECK(statistics.of_ring[0] == 2U * 2082);
  CHECK(statistics.of_ring[1] == 2U * 2083);
  // The lowest ring is 4.2 m away on level ground, 1.73 m below.
  CHECK(statistics.of_range[kRangeBins.of(1.73 / std::sin(-hdl64_elevation_rad(0)))] > 0);
  CHECK(statistics.of_range[kRangeBins.of(3.9)] == 0);
  const auto num_ground = std::count(sweep.ground.begin() + 1, sweep.ground.begin() + sweep.size, kGround);
  const ScanFigures figures = figures_of(statistics);
  CHECK(figures.returns_per_sweep == sweep.size - 1);
  CHECK(figures.ground_percent == Approx(100.0 * static_cast<double>(num_ground) / (sweep.size - 1)));
  CHECK(figures.ground_intensity == 100.0);
  CHECK(figures.other_intensity == 100.0);
}

TEST_CASE("of a dual return the strongest counts", "[evaluation][scan]") {
  Sweep sweep = sweep_of(wall_ahead());
  sweep.echo[7] = kNotStrongest;
  ScanStatistics statistics;
  add_returns(sweep, statistics);
  CHECK(statistics.returns == sweep.size - 1);
}

TEST_CASE("a plane of known noise gives its residual at every range", "[evaluation][scan]") {
  Sweep sweep = sweep_of(Scene().level_ground());
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0F, 0.02F);
  for (std::uint32_t i = 0; i < sweep.size; ++i) sweep.z_m[i] += noise(random);
  ScanStatistics statistics;
  add_ground_patches(sweep, statistics);
  CHECK(statistics.patch_rms_m[0].size() > 5);
  for (std::size_t bin = 0; bin < 4; ++bin)
    CHECK(median_value(statistics.patch_rms_m[bin]) == Approx(0.02).epsilon(0.06));

  SECTION("what is no ground has none") {
    std::ranges::fill(sweep.ground, kNonGround);
    ScanStatistics nothing;
    add_ground_patches(sweep, nothing);
    CHECK(nothing.patch_rms_m[1].empty());
    CHECK(std::isnan(figures_of(nothing).near_residual_m));
  }
}

TEST_CASE("a known share of dropouts is found, by incidence", "[evaluation][scan]") {
  Sweep sweep = sweep_of(wall_ahead());
  SECTION("none where none is") {
    ScanStatistics statistics;
    add_surfaces(sweep, statistics);
    for (const double incidence_deg : {5.0, 25.0, 65.0, 75.0, 85.0}) {
      INFO(incidence_deg);
      CHECK(dropout_at(statistics, incidence_deg) == 0.0);
    }
  }
  SECTION("of the wall, that the beams meet squarely") {
    lose(sweep, 0.1, kNonGround);
    ScanStatistics statistics;
    add_surfaces(sweep, statistics);
    CHECK(dropout_at(statistics, 5.0) == Approx(10.0).margin(1.5));
    CHECK(dropout_at(statistics, 25.0) == Approx(10.0).margin(1.0));
    CHECK(dropout_at(statistics, 85.0) < 0.5);
    CHECK(figures_of(statistics).dropout_percent == Approx(10.0).margin(1.0));
  }
  SECTION("of the ground, that they graze") {
    lose(sweep, 0.3, kGround);
    ScanStatistics statistics;
    add_surfaces(sweep, statistics);
    CHECK(dropout_at(statistics, 5.0) == 0.0);
    CHECK(dropout_at(statistics, 75.0) == Approx(30.0).margin(1.0));
    CHECK(figures_of(statistics).grazing_dropout_percent == Approx(30.0).margin(1.0));
  }
}

TEST_CASE("a hole is no dropout", "[evaluation][scan]") {
  Sweep sweep = sweep_of(wall_ahead());
  for (int ring = 40; ring < 60; ++ring)
    for (int column = 1035; column < 1045; ++column) sweep.range_image.at(ring, column) = RangeImage::kEmpty;
  ScanStatistics statistics;
  add_surfaces(sweep, statistics);
  CHECK(dropout_at(statistics, 5.0) == 0.0);
}

TEST_CASE("columns that were left empty to make room are no dropouts", "[evaluation][scan]") {
  const Sweep sweep = sweep_of(wall_ahead());
  Sweep spread = sweep_of(wall_ahead(), {.columns = 2208});  // the same wall; its image is written anew
  spread.header.num_columns = 2208;
  spread.range_image.clear(2208);
  std::copy_n(sweep.x_m.begin(), sweep.size, spread.x_m.begin());
  std::copy_n(sweep.y_m.begin(), sweep.size, spread.y_m.begin());
  std::copy_n(sweep.z_m.begin(), sweep.size, spread.z_m.begin());
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    spread.range_image.at(sweep.ring[i], sweep.column[i] * 2208 / 2083) = static_cast<std::int32_t>(i);
  ScanStatistics statistics;
  add_surfaces(spread, statistics);
  CHECK(dropout_at(statistics, 25.0) == 0.0);
  CHECK(dropout_at(statistics, 75.0) == 0.0);
}

TEST_CASE("range noise is told from one firing to the next", "[evaluation][scan]") {
  ScanStatistics statistics;
  add_surfaces(sweep_of(wall_ahead(), {.noise_m = 0.012}), statistics);
  CHECK(range_noise_m(statistics.surfaces[kIncidenceBins.of(25.0)]) == Approx(0.012).epsilon(0.05));
  CHECK(figures_of(statistics).range_noise_m == Approx(0.012).epsilon(0.05));
}

TEST_CASE("how far a sweep lies from the one before it", "[evaluation][scan]") {
  const Cloud earlier = floor_of(0.25, 0.005, 1);
  SECTION("in place, only noise is left") {
    ScanStatistics statistics;
    add_overlap(earlier, floor_of(0.25, 0.005, 2), statistics);
    // Half of a normal distribution lies within 0.6745 deviations.
    CHECK(figures_of(statistics).overlap_m == Approx(0.6745 * 0.005).epsilon(0.1));
    CHECK(statistics.unmatched == 0);
  }
  SECTION("2 cm too high") {
    ScanStatistics statistics;
    add_overlap(earlier, floor_of(0.27, 0.005, 2), statistics);
    CHECK(figures_of(statistics).overlap_m == Approx(0.02).epsilon(0.05));
  }
  SECTION("where the sweep before saw nothing") {
    ScanStatistics statistics;
    add_overlap(earlier, floor_of(3.25, 0.005, 2), statistics);
    CHECK(figures_of(statistics).unmatched_percent == 100.0);
    CHECK(std::isnan(figures_of(statistics).overlap_m));
  }
  SECTION("what is no surface has no distance") {
    Cloud leaves;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(0.0F, 3.0F);
    for (int i = 0; i < 20'000; ++i) leaves.push_back({anywhere(random), anywhere(random), anywhere(random)});
    ScanStatistics statistics;
    add_overlap(leaves, leaves, statistics);
    CHECK(figures_of(statistics).unmatched_percent > 99.0);
  }
}

TEST_CASE("drives stand side by side in a table and as JSON", "[evaluation][scan]") {
  ScannedDrive full{"full", {}}, empty{"empty", {}};
  add_returns(sweep_of(wall_ahead()), full.statistics);
  const std::string table = scan_table({full, empty});
  CHECK_THAT(table, Contains("[1] full, 1 sweeps") && Contains("[2] empty, 0 sweeps"));
  CHECK_THAT(table, Contains("intensity of ground, median                      100         n/a\n"));
  const auto json = nlohmann::json::parse(scan_json({full, empty})).at("drives");
  CHECK(json.at(0).at("source") == "full");
  CHECK(json.at(0).at("figures").at("ground_intensity") == 100.0);
  CHECK(json.at(0).at("returns_of_ring").at(5) == 2083);
  CHECK(json.at(1).at("figures").at("ground_percent").is_null());
  CHECK(json.at(0).at("figures").size() == scan_figures().size());
}

}  // namespace
