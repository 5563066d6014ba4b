// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "pago/features/feature_image.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::features;

namespace {

void add(Sweep& sweep,
         double azimuth_deg,
         double elevation_deg,
         double range_m,
         std::uint8_t ground = kNonGround) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180.0,
               elevation = elevation_deg * std::numbers::pi / 180.0;
  const std::uint32_t i = sweep.size++;
  sweep.x_m[i] = static_cast<float>(range_m * std::cos(elevation) * std::cos(azimuth));
  sweep.y_m[i] = static_cast<float>(range_m * std::cos(elevation) * std::sin(azimuth));
  sweep.z_m[i] = static_cast<float>(range_m * std::sin(elevation));
  sweep.ground[i] = ground;
}

}  // namespace

TEST_CASE("the last return of a pixel stays, and one of ground makes it ground", "[features][grid]") {
  Sweep sweep(10);
  UniformGrid grid({}, 1.0, 10);
  add(sweep, 0.05, -10.0, 8.0, kGround);
  add(sweep, -0.05, -10.05, 9.0, kNonGround);  // the same pixel
  add(sweep, 90.0, -10.0, 9.0, kNonGround);
  const FeatureImage image = grid.project(sweep);
  const int row = static_cast<int>((-10.0 + 24.9) / 0.427);
  REQUIRE(image.cells.at(row, 900) == 1);
  REQUIRE(image.cells.at(row, 450) == 2);  // clockwise: the left side comes before the front
  REQUIRE(image.ground[1] == kGround);
  REQUIRE(image.ground[2] == kNonGround);
  REQUIRE(sweep.ground[1] == kNonGround);
}

TEST_CASE("returns outside the grid, too close or not finite have no pixel", "[features][grid]") {
  Sweep sweep(10);
  UniformGrid grid({}, 1.0, 10);
  add(sweep, 0.0, -25.5, 8.0);  // more than a row below the bottom
  add(sweep, 0.0, 5.0, 8.0);    // above the top
  add(sweep, 0.0, 0.0, 0.9);
  add(sweep, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN());
  add(sweep, 0.0, 0.0, std::numeric_limits<double>::infinity());
  add(sweep, 180.0, 0.0, 5.0);
  const FeatureImage image = grid.project(sweep);
  int taken = 0;
  for (int row = 0; row < kNumRings; ++row)
    for (int column = 0; column < image.columns; ++column) taken += image.cells.at(row, column) >= 0 ? 1 : 0;
  REQUIRE(taken == 1);
  REQUIRE(image.cells.at(static_cast<int>(24.9 / 0.427), 0) == 5);
}

TEST_CASE("the grid is what the formulas say, return by return", "[features][grid]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> azimuth(-180.0, 180.0), elevation(-26.0, 4.0), range(0.5, 80.0);
  Sweep sweep(20'000);
  for (int i = 0; i < 20'000; ++i) add(sweep, azimuth(random), elevation(random), range(random));
  UniformGrid grid({}, 1.0, 20'000);
  const FeatureImage image = grid.project(sweep);
  std::map<std::pair<int, int>, std::int32_t> expected;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
    if (std::hypot(x, y, z) < 1.0F) continue;
    constexpr double kPerRadian = 180.0 / std::numbers::pi;
    const double up = static_cast<double>(std::atan2(z, std::hypot(x, y))) * kPerRadian;
    const double right = static_cast<double>(std::atan2(-y, x)) * kPerRadian;
    const double row = (up + 24.9) / 0.427;
    if (row <= -1.0 || row >= 64.0) continue;
    expected[{static_cast<int>(row), (static_cast<int>(std::lround(right / 0.2)) + 900) % 1800}] =
        static_cast<std::int32_t>(i);
  }
  std::size_t wrong = 0;
  for (const auto& [cell, i] : expected) wrong += image.cells.at(cell.first, cell.second) == i ? 0U : 1U;
  REQUIRE(expected.size() > 5000);
  REQUIRE(wrong < 20);  // float against double on the edge between two cells
}
