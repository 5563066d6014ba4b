// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/ransac_plane.hpp"

#include <random>
#include <set>
#include <vector>

#include "src/ground/random.hpp"
#include "support/catch.hpp"
#include "tests/ground/point_lists.hpp"

using namespace pago::ground;
using Eigen::Vector3d;

namespace {

constexpr RansacRule kRule{.inlier_distance_m = 0.1, .max_iterations = 200, .confidence = 0.99};

/// `ground` points of a slope and as many clutter above it.
PointLists slope_with_clutter(int ground, int clutter) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-20.0, 20.0), height(0.5, 6.0);
  std::normal_distribution<double> noise(0.0, 0.02);
  PointLists cloud;
  const auto slope = [](double x, double y) { return 0.1 * x - 0.05 * y - 1.7; };
  for (int i = 0; i < ground + clutter; ++i) {
    const double x = place(random), y = place(random);
    cloud.add({x, y, slope(x, y) + (i < ground ? noise(random) : height(random))});
  }
  return cloud;
}

}  // namespace

TEST_CASE("the plane of most points is found among as many others", "[ground][ransac_plane]") {
  const PointLists cloud = slope_with_clutter(2000, 2000);
  const PlaneFit plane = ransac_plane(cloud.view(), kRule, 1);
  REQUIRE(plane.is_valid);
  CHECK(plane.normal.z() > 0.0);
  CHECK((plane.normal - Vector3d(-0.1, 0.05, 1.0).normalized()).norm() < 5e-3);
  CHECK(plane.height_at({0.0, 0.0}) == Approx(-1.7).margin(0.02));
}

TEST_CASE("the same seed gives the same plane to the last bit, another seed another sample",
          "[ground][ransac_plane]") {
  const PointLists cloud = slope_with_clutter(500, 1500);
  const RansacRule hasty{.inlier_distance_m = 0.02, .max_iterations = 5, .confidence = 0.99};
  CHECK(ransac_plane(cloud.view(), hasty, 7).normal == ransac_plane(cloud.view(), hasty, 7).normal);
  CHECK(ransac_plane(cloud.view(), hasty, 7).normal != ransac_plane(cloud.view(), hasty, 8).normal);
}

TEST_CASE("a wall of more points than the ground wins only if it may", "[ground][ransac_plane]") {
  PointLists cloud;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) {
      if (i < 15) cloud.add({0.5 * i, 0.5 * k, -1.7});
      cloud.add({10.0, 0.5 * i, 0.1 * k});
    }
  CHECK(ransac_plane(cloud.view(), kRule, 1).normal.x() == Approx(1.0).margin(0.01));
  RansacRule upright = kRule;
  upright.min_uprightness = 0.7;
  CHECK(ransac_plane(cloud.view(), upright, 1).normal.z() == Approx(1.0).margin(0.01));
}

TEST_CASE("no plane goes through two points, a line, or nothing", "[ground][ransac_plane]") {
  PointLists cloud;
  CHECK_FALSE(ransac_plane(cloud.view(), kRule, 1).is_valid);
  cloud.add({1, 2, 3});
  cloud.add({4, 5, 6});
  CHECK_FALSE(ransac_plane(cloud.view(), kRule, 1).is_valid);
  cloud = {};
  for (int i = 0; i < 100; ++i) cloud.add({0.25 * i, 0.5 * i, 0.0});
  CHECK_FALSE(ransac_plane(cloud.view(), kRule, 1).is_valid);
}

TEST_CASE("random numbers are spread evenly below their bound", "[ground][random]") {
  Random random(1);
  std::vector<int> hits(10, 0);
  for (int i = 0; i < 100'000; ++i) ++hits.at(random.below(10));
  for (const int n : hits) CHECK(std::abs(n - 10'000) < 500);
  std::set<std::uint64_t> different;
  for (std::uint64_t i = 0; i < 1000; ++i) different.insert(scramble(i));
  CHECK(different.size() == 1000);
  CHECK(unit_interval(0) == 0.0);
  CHECK(unit_interval(~0ULL) < 1.0);
}
