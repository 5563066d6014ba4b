// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/loam_matching.hpp"

#include <random>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

constexpr double kRadius_m = 5.0;

RowCloud random_rows(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> at(-15.0F, 15.0F);
  RowCloud cloud;
  for (std::size_t row = 0; row < kNumRings; ++row) {
    const std::size_t n = row % 7 == 3 ? 0 : random() % 40;
    for (std::size_t i = 0; i < n; ++i) cloud.points.emplace_back(at(random), at(random), 0.2F * at(random));
    cloud.begin[row + 1] = static_cast<std::uint32_t>(cloud.points.size());
  }
  return cloud;
}

int row_of(const RowCloud& cloud, std::uint32_t i) {
  int row = 0;
  while (cloud.begin[static_cast<std::size_t>(row) + 1] <= i) ++row;
  return row;
}

/// The nearest to `query` of all points that `may`, or -1: goes through all of them.
template <typename May>
int nearest(const RowCloud& cloud, const Eigen::Vector3f& query, May may) {
  int best = -1;
  float least = static_cast<float>(kRadius_m * kRadius_m);
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i) {
    const float squared = (cloud.points[i] - query).squaredNorm();
    if (may(i) && squared < least) least = squared, best = static_cast<int>(i);
  }
  return best;
}

}  // namespace

TEST_CASE("neighbours are those that going through all features finds", "[odometry][loam]") {
  LoamTargets targets(kRadius_m);
  targets.build(random_rows(4));
  const RowCloud& cloud = targets.cloud();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-18.0F, 18.0F);
  int lines = 0, planes = 0, none = 0;
  for (int n = 0; n < 2000; ++n) {
    const Eigen::Vector3f query(at(random), at(random), 0.2F * at(random));
    const int a = nearest(cloud, query, [](std::uint32_t) { return true; });
    const auto line = targets.find_line(query);
    const auto plane = targets.find_plane(query);
    int beside = -1, other = -1;
    if (a >= 0) {
      const int row = row_of(cloud, static_cast<std::uint32_t>(a));
      beside = nearest(cloud, query,
                       [&](std::uint32_t i) { return row_of(cloud, i) == row && static_cast<int>(i) != a; });
      other = nearest(cloud, query, [&](std::uint32_t i) {
        const int apart = std::abs(row_of(cloud, i) - row);
        return apart == 1 || apart == 2;
      });
    }
    REQUIRE(line.has_value() == (other >= 0));
    REQUIRE(plane.has_value() == (other >= 0 && beside >= 0));
    if (line) REQUIRE(*line == std::array{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(other)});
    if (plane)
      REQUIRE(*plane == std::array{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(beside),
                                   static_cast<std::uint32_t>(other)});
    lines += line ? 1 : 0, planes += plane ? 1 : 0, none += line ? 0 : 1;
  }
  REQUIRE(lines > 500);
  REQUIRE(planes > 500);
  REQUIRE(none > 20);
}

TEST_CASE("no features, no neighbours", "[odometry][loam]") {
  LoamTargets targets(kRadius_m);
  REQUIRE_FALSE(targets.find_line({0, 0, 0}));
  targets.build({});
  REQUIRE_FALSE(targets.find_plane({0, 0, 0}));
}

TEST_CASE("the offset's direction is the slope of its distance", "[odometry][loam]") {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (int n = 0; n < 200; ++n) {
    const Eigen::Vector3d p = draw(), a = draw(), b = draw(), c = draw();
    const auto line = offset_from_line(p, a, b);
    const auto plane = offset_from_plane(p, a, b, c);
    REQUIRE(line);
    REQUIRE(plane);
    REQUIRE(line->distance_m == Approx((p - a).cross(p - b).norm() / (a - b).norm()));
    REQUIRE(std::abs((p - plane->distance_m * plane->normal - a).dot((b - a).cross(c - a))) < 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-6;
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const double slope =
          (offset_from_line(p + step, a, b)->distance_m - offset_from_line(p - step, a, b)->distance_m) /
          (2.0 * kStep);
      REQUIRE(line->normal[axis] == Approx(slope).margin(1e-5));
      const double tilt = (offset_from_plane(p + step, a, b, c)->distance_m -
                           offset_from_plane(p - step, a, b, c)->distance_m) /
                          (2.0 * kStep);
      REQUIRE(plane->normal[axis] == Approx(tilt).margin(1e-5));
    }
  }
}

TEST_CASE("points in one place are no line, points on a line no plane", "[odometry][loam]") {
  const Eigen::Vector3d p(1, 2, 3), a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  REQUIRE_FALSE(offset_from_line(p, a, a));
  REQUIRE_FALSE(offset_from_line(b, a, c));  // on the line: no direction
  REQUIRE_FALSE(offset_from_plane(p, a, b, c));
}
