// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/segment_lines.hpp"

#include <vector>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::ground;

namespace {

std::vector<GroundLine> extract(const std::vector<RangeHeight>& points, const LinefitConfig& config = {}) {
  std::vector<GroundLine> lines(max_lines(points.size()));
  lines.resize(extract_lines(points, -1.7, config, lines));
  return lines;
}

/// Half a metre apart from 3 m on; the height of each.
std::vector<RangeHeight> profile(const std::vector<double>& heights) {
  std::vector<RangeHeight> points;
  for (const double z : heights)
    points.push_back({3.0F + 0.5F * static_cast<float>(points.size()), static_cast<float>(z)});
  return points;
}

}  // namespace

TEST_CASE("level ground is one line, with a little reach beyond its ends", "[ground][segment_lines]") {
  const auto lines = extract(profile({-1.7, -1.69, -1.71, -1.7, -1.7}));
  REQUIRE(lines.size() == 1);
  CHECK(std::abs(lines[0].slope) < 0.01F);
  CHECK(lines[0].holds(2.95F));
  CHECK(lines[0].holds(5.05F));
  CHECK_FALSE(lines[0].holds(2.85F));
  CHECK(lines[0].above({4.0F, -1.5F}) == Approx(0.2).margin(0.02));
}

TEST_CASE("a ramp is a line of its own, and an obstacle on it is in none", "[ground][segment_lines]") {
  auto points = profile({-1.7, -1.7, -1.7, -1.7});
  for (int i = 1; i <= 8; ++i)
    points.push_back({4.5F + 0.5F * static_cast<float>(i), -1.7F + 0.1F * static_cast<float>(i)});
  const auto lines = extract(points);
  REQUIRE(lines.size() == 2);
  CHECK(lines[1].slope == Approx(0.2).margin(0.02));
  points[8].z_m += 1.0F;
  for (const GroundLine& line : extract(points))
    if (line.holds(points[8].range_m)) CHECK(std::abs(line.above(points[8])) > 0.5F);
}

TEST_CASE("no line begins far above the ground, or steeper than allowed", "[ground][segment_lines]") {
  CHECK(extract(profile({-0.7, -0.7, -0.7, -0.7})).empty());
  CHECK(extract(profile({-1.7, -1.5, -1.3, -1.1, -0.9})).empty());
  LinefitConfig steep;
  steep.max_slope = 0.5;
  CHECK(extract(profile({-1.7, -1.5, -1.3, -1.1, -0.9}), steep).size() == 1);
}

TEST_CASE("two points are no line, nor is nothing", "[ground][segment_lines]") {
  CHECK(extract({}).empty());
  CHECK(extract(profile({-1.7})).empty());
  CHECK(extract(profile({-1.7, -1.7})).empty());
  CHECK(extract(profile({-1.7, -1.7, -1.7})).size() == 1);
}

TEST_CASE("over a long gap a line goes on only where it foretells the height", "[ground][segment_lines]") {
  auto points = profile({-1.7, -1.7, -1.7, -1.7});
  points.push_back({8.0F, -1.66F});
  CHECK(extract(points).at(0).holds(8.0F));
  points.back().z_m = -1.55F;
  CHECK_FALSE(extract(points).at(0).holds(8.0F));
}

TEST_CASE("two returns at the very same range do no harm", "[ground][segment_lines]") {
  std::vector<RangeHeight> points{{3.0F, -1.7F}, {3.0F, -1.7F}, {3.5F, -1.7F}, {4.0F, -1.7F}, {4.5F, -1.7F}};
  for (const GroundLine& line : extract(points)) CHECK(std::abs(line.slope) < 0.01F);
}
