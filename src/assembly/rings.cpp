// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pago {
namespace {

/// Within a ring the azimuth falls back by up to 0.12 rad (parallax of near objects, compensation), between
/// rings by 5.6 rad or more (17 scans measured); in open country a ring may end early, so the bound is low.
constexpr float kWrapRev = 0.08F;
/// Fewer stretches than this are not rings of an HDL-64E with a few missing.
constexpr int kMinSegments = 48;

/// Calls visit(i, segment) for every point in file order; segments are separated by wraps. Returns how many
/// there are.
template <typename Visit>
int for_each_in_segments(std::span<const float> turn, Visit visit) {
  int segment = 0;
  float last_rev = 0.0F;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    if (turn[i] != kNoTurn) {
      // Azimuth counter-clockwise from the front, as the file is sorted.
      const float rev = turn[i] <= 0.5F ? 0.5F - turn[i] : 1.5F - turn[i];
      if (rev < last_rev - kWrapRev) ++segment;
      last_rev = rev;
    }
    visit(i, segment);
  }
  return segment + 1;
}

}  // namespace

float ring_by_elevation(float x_m, float y_m, float z_m) noexcept {
  // Fitted to 153 raw scans of drive 2011_09_26_0005: each block's beams are evenly spaced to 0.1 degrees and
  // leave from one height. Beams that leave above the origin look steeper the nearer they hit.
  constexpr float kUpperHeightM = 0.204F, kUpperTopDeg = 1.94F, kUpperStepDeg = 0.3435F;
  constexpr float kLowerHeightM = 0.121F, kLowerTopDeg = -9.03F, kLowerStepDeg = 0.515F;
  constexpr float kBetweenDeg = -8.87F;
  constexpr float kDegPerRad = 57.29578F;
  const float ground_range_m = std::sqrt(x_m * x_m + y_m * y_m);
  const float upper_deg = std::atan2(z_m - kUpperHeightM, ground_range_m) * kDegPerRad;
  if (upper_deg > kBetweenDeg)
    return std::clamp(63.0F - (kUpperTopDeg - upper_deg) / kUpperStepDeg, 32.0F, 63.0F);
  const float lower_deg = std::atan2(z_m - kLowerHeightM, ground_range_m) * kDegPerRad;
  return std::clamp(31.0F - (kLowerTopDeg - lower_deg) / kLowerStepDeg, 0.0F, 31.0F);
}

RingSource RingFinder::assign(Sweep& sweep, std::span<const float> turn) noexcept {
  const int num_segments = for_each_in_segments(turn, [](std::size_t, int) {});
  if (num_segments == kNumRings) {
    for_each_in_segments(turn, [&](std::size_t i, int segment) {
      sweep.ring[i] = static_cast<std::uint8_t>(kNumRings - 1 - segment);
    });
    return RingSource::kWraps;
  }
  if (num_segments >= kMinSegments && num_segments < kNumRings && assign_segments(sweep, turn, num_segments))
    return RingSource::kSegments;
  for (std::size_t i = 0; i < turn.size(); ++i)
    sweep.ring[i] =
        static_cast<std::uint8_t>(std::lround(ring_by_elevation(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i])));
  return RingSource::kElevation;
}

bool RingFinder::assign_segments(Sweep& sweep, std::span<const float> turn, int num_segments) noexcept {
  // From the bottom up, as rings count.
  const auto rank = [&](int segment) { return static_cast<std::size_t>(num_segments - 1 - segment); };
  std::array<double, kNumRings> sum{};
  std::array<int, kNumRings> count{};
  for_each_in_segments(turn, [&](std::size_t i, int segment) {
    if (turn[i] == kNoTurn) return;
    sum[rank(segment)] += static_cast<double>(ring_by_elevation(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]));
    ++count[rank(segment)];
  });
  std::array<float, kNumRings> mean{};
  const auto n = static_cast<std::size_t>(num_segments);
  for (std::size_t s = 0; s < n; ++s) mean[s] = static_cast<float>(sum[s] / std::max(1, count[s])) + 0.5F;
  if (!std::is_sorted(mean.begin(), mean.begin() + num_segments)) return false;

  const std::span<const int> rings = spreader_.spread(std::span(mean).first(n), kNumRings);
  for_each_in_segments(turn, [&](std::size_t i, int segment) {
    sweep.ring[i] = static_cast<std::uint8_t>(rings[rank(segment)]);
  });
  return true;
}

}  // namespace pago
