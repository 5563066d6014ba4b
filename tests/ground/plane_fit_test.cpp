// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/plane_fit.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "support/catch.hpp"
#include "tests/ground/point_lists.hpp"

using namespace pago::ground;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

const HalfSpace kEverything = HalfSpace::below_height(1e6F);

/// Points in a 4 m wide patch around `centre` of the plane with this normal, `noise_m` off it.
PointLists patch(const Vector3d& centre, const Vector3d& normal, int n, double noise_m) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(-2.0, 2.0);
  std::normal_distribution<double> off(0.0, noise_m);
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  PointLists cloud;
  for (int i = 0; i < n; ++i)
    cloud.add(centre + along(random) * u + along(random) * v + off(random) * normal);
  return cloud;
}

}  // namespace

TEST_CASE("a plane through noisy points 60 m away is found to a milliradian", "[ground][plane_fit]") {
  const Vector3d normal = Vector3d(0.15, -0.1, 1.0).normalized(), centre(50.0, -33.0, -1.4);
  const PointLists cloud = patch(centre, normal, 1000, 0.02);
  const PlaneFit fit =
      fit_plane(statistics_inside(cloud.view(), kEverything, Vector3f(51.0F, -31.0F, -1.5F)));
  REQUIRE(fit.is_valid);
  CHECK(std::acos(std::min(1.0, fit.normal.dot(normal))) < 1e-3);
  CHECK(std::abs(normal.dot(fit.mean - centre)) < 2e-3);
  CHECK(std::sqrt(fit.variance[0]) == Approx(0.02).epsilon(0.1));
}

TEST_CASE("statistics agree with double arithmetic about any near origin", "[ground][plane_fit]") {
  const PointLists cloud = patch({70.0, 20.0, -2.0}, Vector3d(0.3, 0.2, 1.0).normalized(), 3001, 0.05);
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = 0; i < cloud.x.size(); ++i)
    mean += Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]).cast<double>();
  mean /= 3001.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const Vector3d d = Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]).cast<double>() - mean;
    covariance += d * d.transpose() / 3001.0;
  }
  for (const Vector3f& origin : {Vector3f(70.0F, 20.0F, -2.0F), Vector3f(75.0F, 14.0F, -1.0F)}) {
    const PointStatistics found = statistics_inside(cloud.view(), kEverything, origin);
    CHECK(found.count == 3001.0);
    CHECK((found.mean - mean).norm() < 1e-5);
    const double distance_m = (origin.cast<double>() - mean).norm();
    // Builds without vector lanes add one by one and round more.
    CHECK((found.covariance - covariance).norm() < 5e-6 * (1.0 + distance_m * distance_m));
  }
}

TEST_CASE("only points strictly inside the half-space count", "[ground][plane_fit]") {
  PointLists cloud;
  for (int i = 0; i < 19; ++i) cloud.add({1.0 * i, 0.5 * (i % 3), i < 7 ? -1.0 : 0.0});
  const auto count = [&](const HalfSpace& h) {
    return statistics_inside(cloud.view(), h, Vector3f::Zero()).count;
  };
  CHECK(count(HalfSpace::below_height(0.5F)) == 19.0);
  CHECK(count(HalfSpace::below_height(0.0F)) == 7.0);
  CHECK(count(HalfSpace::below_height(-1.0F)) == 0.0);
  CHECK(count({1.0F, 0.0F, 0.0F, 4.0F}) == 4.0);
  CHECK(count({0.0F, 0.0F, 0.0F, -std::numeric_limits<float>::infinity()}) == 0.0);
}

TEST_CASE("normals never point down, whichever way the plane faces", "[ground][plane_fit]") {
  for (const Vector3d& n : {Vector3d(0, 0, -1), Vector3d(0.9, 0.1, -0.2), Vector3d(-0.2, 0.9, 0.3)}) {
    const PointLists cloud = patch({5, 5, 0}, n.normalized(), 300, 0.01);
    const PlaneFit fit = fit_plane(statistics_inside(cloud.view(), kEverything, Vector3f(5, 5, 0)));
    REQUIRE(fit.is_valid);
    CHECK(fit.normal.z() >= 0.0);
    CHECK(std::abs(fit.normal.dot(n.normalized())) > 0.999);
  }
}

TEST_CASE("points on a line give some plane that holds the line", "[ground][plane_fit]") {
  PointLists cloud;
  const Vector3d along = Vector3d(1.0, 2.0, 0.1).normalized();
  for (int i = 0; i < 50; ++i) cloud.add(0.125 * i * along);
  const PlaneFit fit = fit_plane(statistics_inside(cloud.view(), kEverything, Vector3f(1, 2, 0)));
  REQUIRE(fit.is_valid);
  CHECK(fit.normal.norm() == Approx(1.0));
  CHECK(std::abs(fit.normal.dot(along)) < 1e-3);
  CHECK(fit.variance[0] >= 0.0);
}

TEST_CASE("fewer than three points, or all in one place, are no plane", "[ground][plane_fit]") {
  PointLists cloud;
  CHECK_FALSE(fit_plane(statistics_inside(cloud.view(), kEverything, Vector3f::Zero())).is_valid);
  cloud.add({1, 2, 3});
  cloud.add({4, 5, 6});
  CHECK_FALSE(fit_plane(statistics_inside(cloud.view(), kEverything, Vector3f::Zero())).is_valid);
  PointLists same;
  for (int i = 0; i < 20; ++i) same.add({1, 2, 3});
  CHECK_FALSE(fit_plane(statistics_inside(same.view(), kEverything, Vector3f(1, 2, 3))).is_valid);
}

TEST_CASE("absurdly high points give no plane instead of nonsense", "[ground][plane_fit]") {
  PointLists cloud;
  for (int i = 0; i < 20; ++i) cloud.add({1.0 * i, 1.0 * (i % 4), 1e30});
  const HalfSpace everything = HalfSpace::below_height(std::numeric_limits<float>::infinity());
  CHECK_FALSE(fit_plane(statistics_inside(cloud.view(), everything, Vector3f::Zero())).is_valid);
}

TEST_CASE("surface variation is 0 for a perfect plane and a third for a ball", "[ground][plane_fit]") {
  PlaneFit fit;
  fit.variance = {0.0, 1.0, 2.0};
  CHECK(fit.surface_variation() == 0.0);
  fit.variance = {1.0, 1.0, 1.0};
  CHECK(fit.surface_variation() == Approx(1.0 / 3.0));
}
