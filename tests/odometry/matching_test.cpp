// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/matching.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

GridIndex index_of(const PointCloud& cloud) {
  GridIndex grid(cloud.size);
  grid.build(cloud);
  return grid;
}

}  // namespace

TEST_CASE("the plane found on a slope seen by several rings is the slope", "[odometry][matching]") {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, -0.05, 1.0).normalized();
  PointCloud cloud(1000);
  for (int ring = 0; ring < 5; ++ring) {
    for (int i = -20; i <= 20; ++i) {
      const double x = 8.0 + 0.4 * ring, y = 0.2 * i;
      const double z = -1.7 - (normal.x() * x + normal.y() * y) / normal.z();
      cloud.add({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}, 0.0F,
                static_cast<std::uint8_t>(ring));
    }
  }
  const GridIndex grid = index_of(cloud);
  const auto plane = find_plane(grid, {8.9F, 0.3F, -2.4F}, 2.0F);
  REQUIRE(plane.has_value());
  REQUIRE(std::abs(plane->normal.dot(normal)) == Approx(1.0).margin(1e-5));
}

TEST_CASE("points of one ring alone make no plane", "[odometry][matching]") {
  PointCloud cloud(100);
  for (int i = -20; i <= 20; ++i) cloud.add({8.0F, 0.2F * static_cast<float>(i), -1.7F}, 0.0F, 7);
  REQUIRE_FALSE(find_plane(index_of(cloud), {8.0F, 0.0F, -1.7F}, 2.0F).has_value());
}

TEST_CASE("the line found along a pole is the pole", "[odometry][matching]") {
  PointCloud cloud(100);
  for (int ring = 20; ring < 28; ++ring) {
    cloud.add({10.0F, 3.0F, 0.1F * static_cast<float>(ring)}, 0.0F, static_cast<std::uint8_t>(ring));
  }
  const auto line = find_line(index_of(cloud), {10.1F, 3.1F, 2.3F}, 2.0F);
  REQUIRE(line.has_value());
  REQUIRE(std::abs(line->direction.z()) == Approx(1.0).margin(1e-6));
  REQUIRE(line->centre.x() == Approx(10.0));
}

TEST_CASE("edge features of one ring alone make no line", "[odometry][matching]") {
  PointCloud cloud(100);
  for (int i = 0; i < 5; ++i) cloud.add({10.0F + 0.3F * static_cast<float>(i), 3.0F, 0.0F}, 0.0F, 20);
  REQUIRE_FALSE(find_line(index_of(cloud), {10.0F, 3.0F, 0.0F}, 2.0F).has_value());
}

TEST_CASE("nothing within the radius means no match", "[odometry][matching]") {
  PointCloud cloud(10);
  cloud.add({10.0F, 3.0F, 0.0F}, 0.0F, 20);
  REQUIRE_FALSE(find_plane(index_of(cloud), {0.0F, 0.0F, 0.0F}, 2.0F).has_value());
  REQUIRE_FALSE(find_line(index_of(cloud), {0.0F, 0.0F, 0.0F}, 2.0F).has_value());
}
