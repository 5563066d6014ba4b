// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/polar_bins.hpp"

#include <limits>
#include <numbers>
#include <random>

#include "pago/core/error.hpp"
#include "src/ground/atan2_turns.hpp"
#include "support/catch.hpp"
#include "tests/ground/reference/points.hpp"

using namespace pago;
using namespace pago::ground;

namespace {

constexpr float kAnyHeight = -1000.0F;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

PolarGrid patchwork_grid() {
  return PolarGrid(
      std::array<PolarZone, 4>{PolarZone{2.7, 2, 16}, {12.3625, 4, 32}, {22.025, 4, 54}, {41.35, 4, 32}},
      80.0);
}

struct CoordinateLists {
  std::vector<float> x, y, z;
  void add(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(x.size()); }
  Coordinates view() const { return {x.data(), y.data(), z.data()}; }
};

CoordinateLists random_points(std::uint32_t n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> range(0.0F, 90.0F), height(-3.0F, 3.0F);
  std::uniform_real_distribution<float> azimuth(-std::numbers::pi_v<float>, std::numbers::pi_v<float>);
  CoordinateLists points;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float r = range(random), a = azimuth(random);
    points.add(r * std::cos(a), r * std::sin(a), height(random));
  }
  return points;
}

std::uint16_t bin_of(const PolarGrid& grid, float x, float y, float z = 0.0F) {
  std::uint16_t bin = 0;
  grid.locate({&x, &y, &z}, 0, 1, kAnyHeight, &bin);
  return bin;
}

bool lies_in(const PolarCell& cell, const test::ZoneBin& bin) {
  const auto sectors = static_cast<float>(PatchworkConfig{}.zone_sectors[bin.zone]);
  return cell.zone == static_cast<int>(bin.zone) && cell.ring == bin.ring &&
         std::lround(cell.right_turns * sectors) == bin.sector;
}

}  // namespace

TEST_CASE("atan2 in turns is within 3e-7 rad all around", "[ground][atan2_turns]") {
  double worst = 0.0;
  for (int i = -200'000; i <= 200'000; ++i) {
    const double angle = std::numbers::pi * i / 200'000.0;
    const float y = static_cast<float>(3.0 * std::sin(angle)), x = static_cast<float>(3.0 * std::cos(angle));
    const double truth = std::atan2(static_cast<double>(y), static_cast<double>(x));
    const double found = 2.0 * std::numbers::pi * static_cast<double>(atan2_turns(y, x));
    worst = std::max(worst, std::abs(found - truth));
  }
  CHECK(worst < 3e-7);
  CHECK(atan2_turns(0.0F, 0.0F) == 0.0F);
  CHECK(atan2_turns(1.0F, 0.0F) == 0.25F);
  CHECK(atan2_turns(0.0F, -1.0F) == 0.5F);
  CHECK(atan2_turns(-1e-30F, 1e-30F) == Approx(-0.125));
}

TEST_CASE("the concentric zone model has 504 bins in 14 rings", "[ground][polar_bins]") {
  const PolarGrid grid = patchwork_grid();
  REQUIRE(grid.num_bins() == 504);
  CHECK(grid.cell(0).ring == 0);
  CHECK(grid.cell(31).zone == 0);
  CHECK(grid.cell(32).zone == 1);
  CHECK(grid.cell(32).ring == 2);
  CHECK(grid.cell(503).ring == 13);
}

TEST_CASE("the centre of a bin lies in it", "[ground][polar_bins]") {
  const PolarGrid grid = patchwork_grid();
  for (int bin = 0; bin < grid.num_bins(); ++bin)
    REQUIRE(bin_of(grid, grid.cell(bin).centre_x_m, grid.cell(bin).centre_y_m) == bin);
}

TEST_CASE("bins agree with double arithmetic except within rounding of a border", "[ground][polar_bins]") {
  const PolarGrid grid = patchwork_grid();
  const PatchworkConfig config;
  const CoordinateLists points = random_points(200'000);
  std::vector<std::uint16_t> bins(points.size());
  grid.locate(points.view(), 0, points.size(), kAnyHeight, bins.data());

  int different = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const test::Point p{{static_cast<double>(points.x[i]), static_cast<double>(points.y[i]), 0.0}, i};
    const bool is_inside = p.range() > config.min_range_m && p.range() <= config.max_range_m;
    const auto truth =
        test::zone_bin_of(p, config.min_range_m, config.max_range_m, config.zone_rings, config.zone_sectors);
    const bool is_right = is_inside ? bins[i] < grid.num_bins() && lies_in(grid.cell(bins[i]), truth)
                                    : bins[i] == grid.num_bins();
    different += is_right ? 0 : 1;
  }
  CHECK(different <= 10);
}

TEST_CASE("returns outside the grid, too low or not finite have no bin", "[ground][polar_bins]") {
  const PolarGrid grid = patchwork_grid();
  const auto none = static_cast<std::uint16_t>(grid.num_bins());
  CHECK(bin_of(grid, 0.0F, 0.0F) == none);
  CHECK(bin_of(grid, 2.7F, 0.0F) == none);
  CHECK(bin_of(grid, 2.701F, 0.0F) != none);
  CHECK(bin_of(grid, 80.0F, 0.0F) != none);
  CHECK(bin_of(grid, 80.001F, 0.0F) == none);
  CHECK(bin_of(grid, 10.0F, 0.0F, kAnyHeight) != none);
  CHECK(bin_of(grid, 10.0F, 0.0F, kAnyHeight - 1.0F) == none);
  for (const float bad : {kNan, kInf, -kInf}) {
    CHECK(bin_of(grid, bad, 1.0F) == none);
    CHECK(bin_of(grid, 10.0F, bad) == none);
    CHECK(bin_of(grid, 10.0F, 0.0F, bad) == none);
  }
}

TEST_CASE("the x axis belongs to the first sector, what is just right of it to the last",
          "[ground][polar_bins]") {
  const PolarGrid grid = patchwork_grid();
  CHECK(bin_of(grid, 5.0F, 0.0F) == 0);
  CHECK(bin_of(grid, 5.0F, -0.0F) == 0);
  CHECK(bin_of(grid, 5.0F, -1e-3F) == 15);
  CHECK(bin_of(grid, 5.0F, -1e-30F) == 15);
}

TEST_CASE("grouping keeps every return once, in its bin, in the sweep's order", "[ground][polar_bins]") {
  const CoordinateLists points = random_points(50'000);
  PolarBins bins(patchwork_grid(), points.size());
  bins.locate(points.view(), points.size(), kAnyHeight);
  bins.sort_rest(points.view());

  std::vector<std::vector<float>> expected(static_cast<std::size_t>(bins.grid().num_bins()) + 1);
  for (std::uint32_t i = 0; i < points.size(); ++i) expected[bins.bin_of()[i]].push_back(points.x[i]);
  for (int bin = 0; bin < bins.grid().num_bins(); ++bin) {
    const Points found = bins.points(bin);
    REQUIRE(std::vector<float>(found.x_m.begin(), found.x_m.end()) ==
            expected[static_cast<std::size_t>(bin)]);
    REQUIRE(found.y_m.size() == found.x_m.size());
  }
}

TEST_CASE("locating in parts gives the same bins as at once", "[ground][polar_bins]") {
  const CoordinateLists points = random_points(10'007);
  PolarBins whole(patchwork_grid(), points.size()), parts(patchwork_grid(), points.size());
  whole.locate(points.view(), points.size(), kAnyHeight);
  for (std::uint32_t until = 0; until < points.size(); until += 613)
    parts.locate(points.view(), until, kAnyHeight);
  parts.locate(points.view(), points.size(), kAnyHeight);
  CHECK(std::equal(whole.bin_of(), whole.bin_of() + points.size(), parts.bin_of()));
}

TEST_CASE("a polar grid refuses bounds that do not rise and more bins than it can number",
          "[ground][polar_bins]") {
  const std::array<PolarZone, 2> falling{PolarZone{10.0, 2, 8}, {5.0, 2, 8}};
  CHECK_THROWS_AS(PolarGrid(falling, 20.0), Error);
  const std::array<PolarZone, 1> beyond{PolarZone{30.0, 2, 8}};
  CHECK_THROWS_AS(PolarGrid(beyond, 20.0), Error);
  const std::array<PolarZone, 1> too_fine{PolarZone{1.0, 1000, 1000}};
  CHECK_THROWS_AS(PolarGrid(too_fine, 20.0), Error);
  const std::array<PolarZone, 1> most{PolarZone{1.0, 186, 352}};
  CHECK_NOTHROW(PolarGrid(most, 20.0));
}
