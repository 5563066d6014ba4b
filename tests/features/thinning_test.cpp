// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "pago/core/stage.hpp"
#include "support/catch.hpp"
#include "support/street.hpp"

using namespace pago;
using namespace pago::features;

namespace {

std::vector<std::uint32_t> list_of(const FixedVector<std::uint32_t>& list) {
  return {list.begin(), list.end()};
}

bool is_part_of(const FixedVector<std::uint32_t>& few, const FixedVector<std::uint32_t>& many) {
  const std::set<std::uint32_t> all(many.begin(), many.end());
  return std::all_of(few.begin(), few.end(), [&](std::uint32_t i) { return all.count(i) == 1; });
}

constexpr int kFewKeyPoints = 2000;  // than the street has to offer

/// The street seen at rest, handed over in so many parts.
Sweep thinned_street(std::uint32_t parts, std::uint64_t sequence = 0) {
  Sweep sweep(test::kStreetReturns);
  test::Street().scan(test::street_start(), Vector6d::Zero(), 0, 0.01, sweep);
  sweep.header.sequence = sequence;
  ThinningConfig config;
  config.key_points = kFewKeyPoints;
  SweepThinner thinner(config, test::kStreetReturns);
  thinner.begin(sweep);
  for (std::uint32_t part = 1; part <= parts; ++part) thinner.accept(sweep, sweep.size * part / parts);
  thinner.finish(sweep);
  return sweep;
}

}  // namespace

TEST_CASE("each list is a part of the one before, and within its limits", "[features][thinning]") {
  const Sweep sweep = thinned_street(1);
  const FeatureLists& lists = sweep.features;
  REQUIRE(lists.dense.size() > 5000);
  REQUIRE(lists.map_points.size() > 3000);
  REQUIRE(lists.key_points.size() == static_cast<std::size_t>(kFewKeyPoints));
  REQUIRE(is_part_of(lists.map_points, lists.dense));
  REQUIRE(is_part_of(lists.key_points, lists.map_points));
  for (const std::uint32_t i : lists.dense)
    REQUIRE(std::hypot(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]) >=
            static_cast<float>(ThinningConfig{}.min_range_m));
}

TEST_CASE("how a sweep is cut into parts does not matter, which sweep it is does", "[features][thinning]") {
  const Sweep whole = thinned_street(1), parts = thinned_street(13), next = thinned_street(1, 1);
  CHECK(list_of(whole.features.dense) == list_of(parts.features.dense));
  CHECK(list_of(whole.features.map_points) == list_of(parts.features.map_points));
  CHECK(list_of(whole.features.key_points) == list_of(parts.features.key_points));
  CHECK(list_of(whole.features.key_points) != list_of(next.features.key_points));
}

TEST_CASE("a voxel keeps one point, and none is preferred", "[features][thinning]") {
  constexpr std::uint32_t kPoints = 8;
  std::array<int, kPoints> chosen{};
  VoxelThinner thinner(1.0, 1000);
  int kept = 0;
  constexpr int kRounds = 2000;
  for (int round = 0; round < kRounds; ++round) {
    thinner.begin(static_cast<std::uint32_t>(round));
    for (std::uint32_t i = 0; i < kPoints; ++i) thinner.offer(10.0F, -20.0F, 3.0F, i);
    REQUIRE(thinner.size() == 1);
    ++chosen[thinner.chosen(0)];
    ++kept;
  }
  for (const int count : chosen) CHECK(std::abs(count - kept / 8) < 70);  // about five deviations
}

TEST_CASE("points of different voxels are all kept, up to the room there is", "[features][thinning]") {
  VoxelThinner thinner(0.5, 100);
  thinner.begin(7);
  for (std::uint32_t i = 0; i < 150; ++i) thinner.offer(static_cast<float>(i), 0.0F, 0.0F, i);
  REQUIRE(thinner.size() == 100);
  std::set<std::uint32_t> chosen;
  for (std::size_t n = 0; n < thinner.size(); ++n) chosen.insert(thinner.chosen(n));
  REQUIRE(chosen.size() == 100);
}

TEST_CASE("returns too near, too far or not finite stay out", "[features][thinning]") {
  Sweep sweep(4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {1.0F, 150.0F, nan, 90.0F}) sweep.x_m[sweep.size++] = x;
  SweepThinner thinner(ThinningConfig{}, 4);
  thinner.begin(sweep);
  thinner.accept(sweep, sweep.size);
  thinner.finish(sweep);
  REQUIRE(list_of(sweep.features.dense) == std::vector<std::uint32_t>{3});
  REQUIRE(list_of(sweep.features.key_points) == std::vector<std::uint32_t>{3});
}
