// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/grid_index.hpp"

#include <limits>
#include <nanoflann.hpp>
#include <random>
#include <set>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

/// nanoflann's view of a cloud: the independent oracle.
struct CloudAdaptor {
  const PointCloud& cloud;
  std::size_t kdtree_get_point_count() const { return cloud.size; }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return cloud.point(i)[static_cast<int>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, CloudAdaptor>, CloudAdaptor, 3, std::size_t>;

PointCloud random_cloud(int n, unsigned seed, float extent_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> plan(-extent_m, extent_m), height(-3.0F, 5.0F);
  PointCloud cloud(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    cloud.add({plan(random), plan(random), height(random)}, 0.0F, static_cast<std::uint8_t>(i % 64));
  return cloud;
}

}  // namespace

TEST_CASE("the nearest feature is the one a kd-tree finds", "[odometry][grid_index]") {
  const PointCloud cloud = random_cloud(5000, 1, 100.0F);
  GridIndex grid(5000);
  grid.build(cloud);
  const CloudAdaptor adaptor{cloud};
  KdTree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  tree.buildIndex();

  const PointCloud queries = random_cloud(3000, 2, 110.0F);
  int found = 0;
  for (std::size_t q = 0; q < queries.size; ++q) {
    const Eigen::Vector3f query = queries.point(q);
    std::size_t index = 0;
    float distance_sq = 0.0F;
    tree.knnSearch(query.data(), 1, &index, &distance_sq);

    const std::int32_t nearest = grid.nearest(query, 5.0F);
    if (distance_sq > 25.0F) {
      REQUIRE(nearest == -1);
      continue;
    }
    ++found;
    REQUIRE(nearest >= 0);
    REQUIRE((grid.points().point(static_cast<std::size_t>(nearest)) - query).squaredNorm() ==
            Approx(distance_sq));
  }
  REQUIRE(found > 1000);
}

TEST_CASE("a radius search visits each feature inside once and none outside", "[odometry][grid_index]") {
  const PointCloud cloud = random_cloud(4000, 3, 20.0F);
  GridIndex grid(4000);
  grid.build(cloud);
  const Eigen::Vector3f query(1.0F, -2.0F, 0.5F);
  std::multiset<float> visited, expected;
  grid.for_each_within(query, 3.7F, [&](std::uint32_t, float distance_sq) { visited.insert(distance_sq); });
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const float distance_sq = (cloud.point(i) - query).squaredNorm();
    if (distance_sq <= 3.7F * 3.7F) expected.insert(distance_sq);
  }
  REQUIRE(expected.size() > 20);
  REQUIRE(visited == expected);
}

TEST_CASE("features beyond the grid are still found", "[odometry][grid_index]") {
  PointCloud cloud(2);
  cloud.add({300.0F, 5.0F, 0.0F}, 0.0F, 0);
  cloud.add({-200.0F, -200.0F, 0.0F}, 0.0F, 0);
  GridIndex grid(2);
  grid.build(cloud);
  REQUIRE(grid.nearest({300.5F, 5.0F, 0.0F}, 2.0F) >= 0);
  REQUIRE(grid.nearest({-200.0F, -199.0F, 0.0F}, 2.0F) >= 0);
  REQUIRE(grid.nearest({0.0F, 0.0F, 0.0F}, 2.0F) == -1);
}

TEST_CASE("an empty index finds nothing, and rebuilding replaces the contents", "[odometry][grid_index]") {
  GridIndex grid(10);
  grid.build(PointCloud(10));
  REQUIRE(grid.nearest({0.0F, 0.0F, 0.0F}, 5.0F) == -1);
  PointCloud cloud(10);
  cloud.add({1.0F, 0.0F, 0.0F}, 0.0F, 0);
  grid.build(cloud);
  REQUIRE(grid.nearest({0.0F, 0.0F, 0.0F}, 5.0F) == 0);
  grid.build(PointCloud(10));
  REQUIRE(grid.nearest({0.0F, 0.0F, 0.0F}, 5.0F) == -1);
}

TEST_CASE("a query that is no number finds nothing and harms nothing", "[odometry][grid_index]") {
  PointCloud cloud(2);
  cloud.add({1.0F, 0.0F, 0.0F}, 0.0F, 0);
  GridIndex grid(2);
  grid.build(cloud);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  REQUIRE(grid.nearest({nan, nan, nan}, 5.0F) == -1);
  REQUIRE(grid.nearest({infinite, -infinite, 0.0F}, 5.0F) == -1);
}
