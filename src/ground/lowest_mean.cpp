// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "lowest_mean.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "float8.hpp"

namespace pago::ground {
namespace {

constexpr std::size_t kGroups = 4 * kLanes;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The k-th lowest (k from 1) of some values, of which there are more than k. Looking at all pairs beats
/// std::nth_element for few: it takes no branch.
float kth_lowest_of_few(const float* values, std::size_t size, std::size_t k) noexcept {
  const auto rank = static_cast<std::int32_t>(k);
  Float8 highest = Float8{} - kInfinity;
  for (std::size_t i = 0; i < size; i += kLanes) {
    Float8 mine;
    load(values + i, mine);
    Int8 num_lower{};
    for (std::size_t j = 0; j < size; ++j) num_lower -= values[j] < mine;
    // Those with fewer than k lower ones end with the k-th.
    const Int8 is_candidate = (num_lower < rank) & (mine > highest);
    highest = is_candidate ? mine : highest;
  }
  float result = highest[0];
  for (std::size_t lane = 1; lane < kLanes; ++lane) result = std::max(result, highest[lane]);
  return result;
}

/// A bound that at least `count` (<= kGroups) values do not exceed, if there are so many: the values are
/// dealt out to groups, and the count-th lowest of the groups' minima has count - 1 others below it. It lies
/// about ten places above the count-th lowest value itself.
float upper_bound_of_lowest(std::span<const float> values, std::size_t count, float floor) noexcept {
  std::array<Float8, kGroups / kLanes> low;
  low.fill(Float8{} + kInfinity);
  const std::size_t whole = values.size() / kGroups * kGroups;
  for (std::size_t i = 0; i < whole; i += kGroups) {
    for (std::size_t g = 0; g < low.size(); ++g) {
      Float8 value;
      load(values.data() + i + g * kLanes, value);
      low[g] = (value >= floor) & (value < low[g]) ? value : low[g];
    }
  }
  std::array<float, kGroups> minima;
  for (std::size_t g = 0; g < low.size(); ++g) store(low[g], minima.data() + g * kLanes);
  return kth_lowest_of_few(minima.data(), kGroups, count);
}

bool any(const Int8& mask) noexcept {
  std::array<std::uint64_t, 4> words;
  std::memcpy(words.data(), &mask, sizeof mask);
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

/// Sum of the `count` lowest; there are at least as many.
double sum_of_lowest(std::span<float> values, std::size_t count, float kth) noexcept {
  double sum = 0.0;
  std::size_t below = 0;
  for (const float value : values) {
    if (!(value < kth)) continue;
    sum += static_cast<double>(value);
    ++below;
  }
  return sum + static_cast<double>(count - below) * static_cast<double>(kth);
}

}  // namespace

LowestMean::LowestMean(std::size_t max_values) : candidates_(max_values + kLanes) {}

std::optional<double> LowestMean::operator()(std::span<const float> values,
                                             std::size_t count,
                                             float floor) noexcept {
  const bool can_bound = count <= kGroups && values.size() > 2 * kGroups;
  const float ceiling = can_bound ? upper_bound_of_lowest(values, count, floor) : kInfinity;
  const std::size_t found = collect(values, floor, ceiling);
  const std::size_t used = std::min(count, found);
  if (used == 0) return std::nullopt;

  constexpr std::size_t kFew = 96;
  float* const first = candidates_.data();
  float kth = kInfinity;
  if (found <= kFew) {
    std::fill_n(first + found, kLanes, kInfinity);
    kth = kth_lowest_of_few(first, (found + kLanes - 1) / kLanes * kLanes, used);
  } else {
    std::nth_element(first, first + used - 1, first + found);
    kth = first[used - 1];
  }
  return sum_of_lowest(candidates_.first(found), used, kth) / static_cast<double>(used);
}

std::size_t LowestMean::collect(std::span<const float> values, float floor, float ceiling) noexcept {
  std::size_t found = 0;
  const auto take = [&](float value) {
    candidates_[found] = value;
    found += ((value >= floor) & (value <= ceiling)) ? 1U : 0U;
  };
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    Float8 eight;
    load(values.data() + i, eight);
    if (!any(eight <= ceiling)) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) take(values[i + lane]);
  }
  for (std::size_t i = whole; i < values.size(); ++i) take(values[i]);
  return found;
}

}  // namespace pago::ground
