// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/ground.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/simulator/city.hpp"
#include "support/catch.hpp"

using namespace pago::simulator;
using Eigen::Vector2d;

namespace {

Ground city_ground(std::uint64_t seed = 2) {
  return Ground(StreetMap(make_city(seed, 300.0).streets), GroundStyle{}, seed);
}

}  // namespace

TEST_CASE("streets keep their heights", "[simulator][ground]") {
  const Ground ground = city_ground();
  double worst = 0.0;
  for (const StreetPoint& point : ground.streets().points())
    worst = std::max(worst, std::abs(ground.road_height_m(ground.spot(point.at)) - point.z_m));
  CHECK(worst < 0.05);
}

TEST_CASE("kerbs are 10 to 15 cm high, but for driveways", "[simulator][ground]") {
  const Ground ground = city_ground();
  std::vector<double> kerbs;
  for (const StreetPoint& point : ground.streets().points()) {
    const Vector2d edge = point.at + (point.half_width_m + 0.01) * point.left();
    Ground::Spot spot = ground.spot(edge);
    if (spot.is_on_road()) continue;  // a crossing
    const double land_m = ground.land_height_m(spot);
    kerbs.push_back(land_m - ground.road_height_m(spot));
  }
  REQUIRE(kerbs.size() > 500);
  std::ranges::sort(kerbs);
  CHECK(kerbs.front() > 0.0);
  CHECK(kerbs[kerbs.size() / 4] > 0.09);
  CHECK(kerbs.back() < 0.17);
  CHECK(kerbs[kerbs.size() / 50] < 0.06);
}

TEST_CASE("the land has no steps off the streets, far away either", "[simulator][ground]") {
  const Ground ground = city_ground();
  double steepest = 0.0;
  for (double x = -100.0; x < 250.0; x += 0.37) {
    const auto here = ground.spot({x, 41.3}), next = ground.spot({x + 0.05, 41.3});
    steepest = std::max(steepest, std::abs(ground.road_height_m(next) - ground.road_height_m(here)) / 0.05);
  }
  CHECK(steepest < 0.5);
}

TEST_CASE("a tile's mesh has upright kerbs, and no holes", "[simulator][ground]") {
  const Ground ground = city_ground();
  Mesh mesh;
  add_ground(mesh, ground, Vector2d(64.0, -32.0), 64);
  double area = 0.0, upright = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d normal = u.cross(v);
    area += 0.5 * std::abs(normal.z());
    if (std::abs(normal.z()) < 1e-3 * normal.norm()) upright += 0.5 * normal.norm();
  }
  CHECK(area == Approx(64.0 * 64.0).epsilon(1e-4));
  CHECK(upright > 5.0);  // two kerbs through the tile, at 12 cm: some 15 square metres
  CHECK(upright < 40.0);
}

TEST_CASE("neighbouring tiles meet without a gap", "[simulator][ground]") {
  const Ground ground = city_ground();
  const auto rim = [&](const Vector2d& corner, float x) {
    Mesh mesh;
    mesh.origin << corner, 0.0;
    add_ground(mesh, ground, corner, 64);
    std::vector<std::pair<float, float>> points;
    for (const Eigen::Vector3f& p : mesh.vertices)
      if (p.x() + static_cast<float>(corner.x()) == x) points.emplace_back(p.y(), p.z());
    std::ranges::sort(points);
    return points;
  };
  const auto left = rim({0.0, -32.0}, 64.0F), right = rim({64.0, -32.0}, 64.0F);
  REQUIRE(left.size() == right.size());
  REQUIRE(left.size() >= 65);
  for (std::size_t i = 0; i < left.size(); ++i) {
    REQUIRE(left[i].first == right[i].first);
    REQUIRE(std::abs(left[i].second - right[i].second) < 1e-4F);
  }
}
