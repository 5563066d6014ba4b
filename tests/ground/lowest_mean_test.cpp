// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/lowest_mean.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "support/catch.hpp"

using pago::ground::LowestMean;

namespace {

constexpr float kNoFloor = -std::numeric_limits<float>::infinity();

std::optional<double> by_sorting(std::vector<float> values, std::size_t count, float floor) {
  std::erase_if(values, [&](float v) { return v < floor; });
  std::sort(values.begin(), values.end());
  if (values.size() > count) values.resize(count);
  if (values.empty()) return std::nullopt;
  double sum = 0.0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

void check_like_sorting(const std::vector<float>& values, std::size_t count, float floor) {
  LowestMean lowest(values.size());
  const auto found = lowest(values, count, floor), expected = by_sorting(values, count, floor);
  REQUIRE(found.has_value() == expected.has_value());
  if (found) REQUIRE(*found == Approx(*expected).epsilon(1e-12));
}

}  // namespace

TEST_CASE("the mean of the lowest is that of a sorted list, for any length, order and floor",
          "[ground][lowest_mean]") {
  std::mt19937 random(11);
  std::normal_distribution<float> height(-1.7F, 0.5F);
  for (std::size_t n : {1U, 2U, 19U, 20U, 21U, 63U, 64U, 65U, 95U, 96U, 97U, 500U, 3001U}) {
    std::vector<float> values(n);
    for (float& v : values) v = height(random);
    for (const std::size_t count : {1U, 10U, 20U, 32U, 33U, 100U}) {
      for (const float floor : {kNoFloor, -1.9F, -1.0F, 5.0F}) {
        check_like_sorting(values, count, floor);
        auto rising = values;
        std::sort(rising.begin(), rising.end());
        check_like_sorting(rising, count, floor);
        std::reverse(rising.begin(), rising.end());
        check_like_sorting(rising, count, floor);
      }
    }
  }
}

TEST_CASE("equal values are no trouble to the lowest mean", "[ground][lowest_mean]") {
  check_like_sorting(std::vector<float>(1000, -1.73F), 20, kNoFloor);
  std::vector<float> steps(1000);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<float>(i % 5);
  check_like_sorting(steps, 20, kNoFloor);
  check_like_sorting(steps, 20, 1.0F);
}

TEST_CASE("the lowest of nothing, or of values that are all under the floor, have no mean",
          "[ground][lowest_mean]") {
  LowestMean lowest(100);
  CHECK_FALSE(lowest({}, 20, kNoFloor).has_value());
  const std::vector<float> low(100, -5.0F);
  CHECK_FALSE(lowest(low, 20, -1.0F).has_value());
}
