// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/clustering.hpp"

#include <cmath>
#include <map>
#include <queue>

#include "support/catch.hpp"
#include "support/street.hpp"

using namespace pago;
using namespace pago::features;

namespace {

/// Plain flood fill with the angle computed as the paper writes it: the oracle for the union-find.
std::vector<int> flood_fill(const Sweep& sweep, const ClusteringConfig& config) {
  using Steps = std::vector<std::pair<int, int>>;
  const Steps steps = config.neighbours == Neighbours::kFour ? Steps{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}
                                                             : Steps{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  const double join_angle_deg = config.join_angle_deg;
  const int columns = static_cast<int>(sweep.header.num_columns);
  std::vector<int> component(sweep.size, -1);
  const auto at = [&](int ring, int column) -> std::int32_t {
    if (ring < 0 || ring >= kNumRings) return -1;
    const std::int32_t i = sweep.range_image.at(ring, (column + columns) % columns);
    return i >= 0 && sweep.ground[static_cast<std::uint32_t>(i)] == kNonGround ? i : -1;
  };
  const auto point = [&](std::int32_t i) {
    const auto k = static_cast<std::uint32_t>(i);
    return Eigen::Vector3d(static_cast<double>(sweep.x_m[k]), static_cast<double>(sweep.y_m[k]),
                           static_cast<double>(sweep.z_m[k]));
  };
  const auto joined = [&](std::int32_t i, std::int32_t k) {
    double d1 = point(i).norm(), d2 = point(k).norm();
    const double a = std::acos(std::min(1.0, point(i).dot(point(k)) / (d1 * d2)));
    if (d1 < d2) std::swap(d1, d2);
    return std::atan2(d2 * std::sin(a), d1 - d2 * std::cos(a)) > join_angle_deg * std::numbers::pi / 180.0;
  };
  int next = 0;
  for (int ring = 0; ring < kNumRings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      const std::int32_t seed = at(ring, column);
      if (seed < 0 || component[static_cast<std::size_t>(seed)] >= 0) continue;
      component[static_cast<std::size_t>(seed)] = next;
      std::queue<std::pair<int, int>> queue({{ring, column}});
      while (!queue.empty()) {
        const auto [r, c] = queue.front();
        queue.pop();
        for (const auto& [dr, dc] : steps) {
          const std::int32_t there = at(r + dr, c + dc);
          if (there < 0 || component[static_cast<std::size_t>(there)] >= 0 || !joined(at(r, c), there))
            continue;
          component[static_cast<std::size_t>(there)] = next;
          queue.push({r + dr, (c + dc + columns) % columns});
        }
      }
      ++next;
    }
  }
  return component;
}

}  // namespace

TEST_CASE("union-find finds the segments that a flood fill finds", "[features][clustering]") {
  Sweep sweep(test::kStreetReturns);
  test::Street().scan(test::street_start(), Vector6d::Zero(), 0, 0.0, sweep);
  ClusteringConfig config;
  config.min_points = 1;
  config.neighbours = GENERATE(Neighbours::kFour, Neighbours::kDiagonal);
  Clusterer(config, test::kStreetReturns).label(sweep);

  const std::vector<int> expected = flood_fill(sweep, config);
  std::map<int, int> label_of_component, component_of_label;
  std::size_t disagree = 0, obstacles = 0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (sweep.ground[i] == kGround) {
      REQUIRE(sweep.cluster[i] == 0);
      continue;
    }
    ++obstacles;
    const int label = sweep.cluster[i], component = expected[i];
    if (label_of_component.try_emplace(component, label).first->second != label) ++disagree;
    if (component_of_label.try_emplace(label, component).first->second != component) ++disagree;
  }
  REQUIRE(obstacles > 10000);
  REQUIRE(component_of_label.size() > 5);
  REQUIRE(disagree == 0);
}

TEST_CASE("segments too small to trust are clutter, small tall ones are not", "[features][clustering]") {
  Sweep sweep(100);
  sweep.header.num_columns = 360;
  const auto add = [&](int ring, int column, float range_m) {
    const float azimuth = static_cast<float>(column) * 0.0174533F,
                elevation = 0.007F * static_cast<float>(ring);
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = range_m * std::cos(elevation) * std::cos(azimuth);
    sweep.y_m[i] = range_m * std::cos(elevation) * std::sin(azimuth);
    sweep.z_m[i] = range_m * std::sin(elevation);
    sweep.ring[i] = static_cast<std::uint8_t>(ring);
    sweep.ground[i] = kNonGround;
    sweep.range_image.at(ring, column) = static_cast<std::int32_t>(i);
  };
  for (int ring = 10; ring < 16; ++ring) add(ring, 20, 10.0F);  // a pole: 6 returns on 6 rings
  for (int column = 100; column < 106; ++column)
    add(30, column, 5.0F);  // a flat scrap: 6 returns on one ring
  Clusterer(ClusteringConfig{}, 100).label(sweep);
  for (std::uint32_t i = 0; i < 6; ++i) REQUIRE(sweep.cluster[i] == 1);
  for (std::uint32_t i = 6; i < 12; ++i) REQUIRE(sweep.cluster[i] == kClutter);
}

TEST_CASE("a segment that crosses the first column is one segment", "[features][clustering]") {
  Sweep sweep(100);
  sweep.header.num_columns = 360;
  for (int k = 0; k < 40; ++k) {
    const int column = (340 + k) % 360;
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = 10.0F * std::cos(static_cast<float>(column) * 0.0174533F);
    sweep.y_m[i] = 10.0F * std::sin(static_cast<float>(column) * 0.0174533F);
    sweep.z_m[i] = 0.0F;
    sweep.range_image.at(5, column) = static_cast<std::int32_t>(i);
  }
  Clusterer(ClusteringConfig{}, 100).label(sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i) REQUIRE(sweep.cluster[i] == 1);
}

TEST_CASE("across corners a row of returns is no segment, and a surface is two", "[features][clustering]") {
  Sweep sweep(400);
  sweep.header.num_columns = 360;
  const auto add = [&](int ring, int column) {
    const std::uint32_t i = sweep.size++;
    const float azimuth = 0.0174533F * static_cast<float>(column), up = 0.0174533F * static_cast<float>(ring);
    sweep.x_m[i] = 5.0F * std::cos(up) * std::cos(azimuth),
    sweep.y_m[i] = 5.0F * std::cos(up) * std::sin(azimuth);
    sweep.z_m[i] = 5.0F * std::sin(up);
    sweep.range_image.at(ring, column) = static_cast<std::int32_t>(i);
  };
  for (int column = 0; column < 40; ++column) add(5, column);
  for (int ring = 20; ring < 30; ++ring)
    for (int column = 100; column < 110; ++column) add(ring, column);
  ClusteringConfig config;
  config.neighbours = Neighbours::kDiagonal;
  Clusterer(config, 400).label(sweep);
  REQUIRE(sweep.cluster[0] == kClutter);
  REQUIRE(sweep.cluster[40] == 1);  // the white fields of a chessboard
  REQUIRE(sweep.cluster[41] == 2);  // the black ones
  Clusterer(ClusteringConfig{}, 400).label(sweep);
  REQUIRE(sweep.cluster[0] == 1);
  REQUIRE(sweep.cluster[41] == sweep.cluster[40]);
}

TEST_CASE("in a grid the angle between beams is the grid's step, not the returns' own",
          "[features][clustering]") {
  Sweep sweep(10);
  sweep.header.num_columns = 360;
  sweep.size = 2;
  // Two returns above each other whose beams are 2 degrees apart, in cells that are 0.427 degrees apart.
  const float up = 0.0349066F, ranges[] = {10.0F, 10.15F};
  for (std::uint32_t i = 0; i < 2; ++i) {
    sweep.x_m[i] = ranges[i] * std::cos(up * static_cast<float>(i));
    sweep.z_m[i] = ranges[i] * std::sin(up * static_cast<float>(i));
    sweep.range_image.at(static_cast<int>(i) + 3, 7) = static_cast<std::int32_t>(i);
  }
  ClusteringConfig config;
  config.min_points = 2, config.min_points_tall = 2, config.min_rings_tall = 2;
  Clusterer clusterer(config, 10);
  clusterer.label(sweep);
  REQUIRE(sweep.cluster[0] == 1);
  FeatureImage image = own_image(sweep);
  image.row_step_rad = 0.00745F;
  clusterer.label(sweep, image);
  REQUIRE(sweep.cluster[0] == kClutter);  // atan2(10 sin 0.427, 10.15 - 10 cos 0.427) is 26 degrees
}

TEST_CASE("an empty sweep has no segments", "[features][clustering]") {
  Sweep sweep(10);
  Clusterer(ClusteringConfig{}, 10).label(sweep);
  SUCCEED();
}
