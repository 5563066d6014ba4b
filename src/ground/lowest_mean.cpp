// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "lowest_mean.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace pago::ground {
namespace {

constexpr std::size_t kGroups = 32;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A bound that at least `count` (<= kGroups) values do not exceed, if there are so many: the values are
/// dealt out to groups, and the count-th lowest of the groups' minima has count - 1 others below it. It lies
/// about ten places above the count-th lowest value itself.
float upper_bound_of_lowest(std::span<const float> values, std::size_t count, float floor) {
  alignas(64) std::array<float, kGroups> low{};
  low.fill(kInfinity);
  const std::size_t whole = values.size() / kGroups * kGroups;
  for (std::size_t i = 0; i < whole; i += kGroups) {
    for (std::size_t g = 0; g < kGroups; ++g) {
      const float value = values[i + g] >= floor ? values[i + g] : kInfinity;
      low[g] = value < low[g] ? value : low[g];
    }
  }
  const auto place = low.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  std::nth_element(low.begin(), place, low.end());
  return *place;
}

}  // namespace

std::optional<double> LowestMean::operator()(std::span<const float> values,
                                             std::size_t count,
                                             float floor) noexcept {
  const bool can_bound = count <= kGroups && values.size() > 2 * kGroups;
  const float ceiling = can_bound ? upper_bound_of_lowest(values, count, floor) : kInfinity;
  const std::size_t found = collect(values, floor, ceiling);
  const std::size_t used = std::min(count, found);
  if (used == 0) return std::nullopt;

  float* const first = candidates_.data();
  std::nth_element(first, first + used - 1, first + found);
  double sum = 0.0;
  for (std::size_t i = 0; i < used; ++i) sum += static_cast<double>(first[i]);
  return sum / static_cast<double>(used);
}

std::size_t LowestMean::collect(std::span<const float> values, float floor, float ceiling) noexcept {
  std::size_t found = 0;
  for (const float value : values) {
    candidates_[found] = value;
    found += ((value >= floor) & (value <= ceiling)) ? 1U : 0U;
  }
  return found;
}

}  // namespace pago::ground
