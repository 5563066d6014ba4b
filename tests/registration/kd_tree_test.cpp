// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/kd_tree.hpp"

#include <algorithm>
#include <array>
#include <random>

#include "support/catch.hpp"

using namespace pago::registration;

namespace {

std::vector<Eigen::Vector3f> random_points(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> at(-20.0F, 20.0F);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(at(random), at(random), 0.1F * at(random));
  return points;
}

}  // namespace

TEST_CASE("the tree finds the five neighbours that going through all finds", "[registration][kd_tree]") {
  KdTree tree;
  const auto points = random_points(2000, 1);
  tree.build(points);
  for (const Eigen::Vector3f& query : random_points(300, 2)) {
    std::vector<std::pair<float, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < points.size(); ++i) all.emplace_back((points[i] - query).squaredNorm(), i);
    std::ranges::sort(all);
    std::array<std::uint32_t, 5> indices{};
    std::array<float, 5> squared{};
    REQUIRE(tree.nearest(query, indices, squared) == 5);
    for (std::size_t k = 0; k < 5; ++k) {
      REQUIRE(indices[k] == all[k].second);
      REQUIRE(squared[k] == Approx(all[k].first));
    }
  }
}

TEST_CASE("a tree of fewer points gives those it has, an empty one none", "[registration][kd_tree]") {
  KdTree tree;
  std::array<std::uint32_t, 5> indices{};
  std::array<float, 5> squared{};
  REQUIRE(tree.nearest({0, 0, 0}, indices, squared) == 0);
  tree.build({{1, 0, 0}, {3, 0, 0}});
  REQUIRE(tree.nearest({0, 0, 0}, indices, squared) == 2);
  REQUIRE(indices[1] == 1);
  REQUIRE(squared[1] == 9.0F);
  tree.build({});
  REQUIRE(tree.nearest({0, 0, 0}, indices, squared) == 0);
}
