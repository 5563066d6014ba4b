// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/voxel_means.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "support/catch.hpp"

using namespace pago::registration;

TEST_CASE("each voxel's points become their mean", "[registration][voxel_means]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> at(-5.0F, 5.0F);
  std::vector<Eigen::Vector3f> points, means;
  for (int i = 0; i < 5000; ++i) points.emplace_back(at(random), at(random), at(random));
  voxel_means(points, 0.5, means);
  std::map<std::tuple<int, int, int>, std::pair<Eigen::Vector3d, int>> expected;
  const auto voxel_of = [](const Eigen::Vector3f& p) {
    const auto cell = [](float x) { return static_cast<int>(std::floor(x * 2.0F)); };
    return std::tuple{cell(p.z()), cell(p.y()), cell(p.x())};  // the order in which they come
  };
  for (const Eigen::Vector3f& p : points) {
    auto& [sum, count] = expected.try_emplace(voxel_of(p), Eigen::Vector3d::Zero(), 0).first->second;
    sum += p.cast<double>(), ++count;
  }
  REQUIRE(means.size() == expected.size());
  std::size_t n = 0;
  for (const auto& [voxel, found] : expected)
    REQUIRE((means[n++].cast<double>() - found.first / found.second).norm() < 1e-6);
}

TEST_CASE("without a voxel the points stay, and what is not finite is left out",
          "[registration][voxel_means]") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), far = 1e30F;
  const std::vector<Eigen::Vector3f> points{{1, 2, 3}, {nan, 0, 0}, {0, far, 0}, {1.1F, 2.1F, 3.1F}};
  std::vector<Eigen::Vector3f> out{{9, 9, 9}};
  voxel_means(points, 1.0, out);
  REQUIRE(out.size() == 2);
  REQUIRE((out[1] - Eigen::Vector3f(1.05F, 2.05F, 3.05F)).norm() < 1e-5F);
  std::vector<Eigen::Vector3f> same;
  voxel_means({points.data(), 1}, 0.0, same);
  REQUIRE(same.size() == 1);
  REQUIRE(same[0] == points[0]);
}
