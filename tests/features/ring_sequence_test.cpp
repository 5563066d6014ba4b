// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "../../src/features/ring_sequence.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::features;

namespace {

RingSequence ring_of(const std::vector<float>& ranges_m, int column_step = 1) {
  RingSequence ring(ranges_m.size());
  for (const float range_m : ranges_m) {
    const std::size_t i = ring.size++;
    ring.range_m[i] = range_m;
    ring.column[i] = static_cast<std::int32_t>(i) * column_step;
    ring.index[i] = static_cast<std::uint32_t>(i);
  }
  return ring;
}

}  // namespace

TEST_CASE("smoothness is the squared sum of range differences, or LOAM's normalised one",
          "[features][smoothness]") {
  std::vector<float> ranges(11, 10.0F);
  ranges[5] = 10.1F;
  RingSequence ring = ring_of(ranges);
  compute_smoothness(ring, Smoothness::kRangeSquared);
  REQUIRE(ring.smoothness[5] == Approx(1.0).epsilon(1e-3));  // (10 * 0.1)^2
  REQUIRE(std::isinf(ring.smoothness[4]));
  REQUIRE(std::isinf(ring.smoothness[6]));
  compute_smoothness(ring, Smoothness::kNormalised);
  REQUIRE(ring.smoothness[5] == Approx(1.0 / 101.0).epsilon(1e-3));
}

TEST_CASE("a ring too short to rate has no smoothness", "[features][smoothness]") {
  RingSequence ring = ring_of(std::vector<float>(10, 5.0F));
  compute_smoothness(ring, Smoothness::kRangeSquared);
  for (std::size_t i = 0; i < ring.size; ++i) REQUIRE(std::isinf(ring.smoothness[i]));
}

TEST_CASE("the far side of a range jump is blocked, the near side is not", "[features][occlusion]") {
  std::vector<float> ranges(30, 5.0F);
  for (std::size_t i = 15; i < 30; ++i) ranges[i] = 9.0F;
  RingSequence ring = ring_of(ranges);
  block_unreliable(ring, FeaturesConfig{});
  for (std::size_t i = 0; i < 15; ++i) REQUIRE(ring.blocked[i] == 0);
  for (std::size_t i = 15; i < 21; ++i) REQUIRE(ring.blocked[i] == 1);
  REQUIRE(ring.blocked[21] == 0);
}

TEST_CASE("across a column gap a range jump hides nothing", "[features][occlusion]") {
  std::vector<float> ranges(30, 5.0F);
  for (std::size_t i = 15; i < 30; ++i) ranges[i] = 9.0F;
  RingSequence ring = ring_of(ranges);
  for (std::size_t i = 15; i < 30; ++i) ring.column[i] += 20;
  block_unreliable(ring, FeaturesConfig{});
  REQUIRE(ring.blocked[16] == 0);
}

TEST_CASE("where the beam grazes a surface nothing is used", "[features][occlusion]") {
  std::vector<float> ranges;
  for (int i = 0; i < 30; ++i)
    ranges.push_back(5.0F * std::pow(1.04F, static_cast<float>(i)));  // 4 % per step, < 0.3 m at first
  RingSequence ring = ring_of(ranges);
  block_unreliable(ring, FeaturesConfig{});
  REQUIRE(ring.blocked[3] == 1);
}

TEST_CASE("a pick blocks five neighbours on each side and stops at a gap", "[features][selection]") {
  RingSequence ring = ring_of(std::vector<float>(30, 5.0F));
  for (std::size_t i = 0; i < 30; ++i) ring.blocked[i] = 0;
  for (std::size_t i = 18; i < 30; ++i) ring.column[i] += 20;
  block_around(ring, 15);
  for (std::size_t i = 0; i < 30; ++i) REQUIRE(static_cast<bool>(ring.blocked[i]) == (i >= 10 && i <= 17));
}
