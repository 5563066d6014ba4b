// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ring_sequence.hpp"

#include <cmath>
#include <limits>

namespace pago::features {

void compute_smoothness(RingSequence& ring, Smoothness measure) noexcept {
  constexpr float kUndefined = std::numeric_limits<float>::infinity();
  const std::size_t n = ring.size;
  for (std::size_t i = 0; i < n; ++i) ring.smoothness[i] = kUndefined;
  if (n < 2 * kReach + 1) return;

  const float* r = ring.range_m.data();
  for (std::size_t i = kReach; i < n - kReach; ++i) {
    float sum = -10.0F * r[i];
    for (std::size_t k = 1; k <= kReach; ++k) sum += r[i - k] + r[i + k];
    ring.smoothness[i] = measure == Smoothness::kRangeSquared ? sum * sum : std::abs(sum) / (10.0F * r[i]);
  }
}

void block_unreliable(RingSequence& ring, const FeaturesConfig& config) noexcept {
  const std::size_t n = ring.size;
  std::fill_n(ring.blocked.data(), n, std::uint8_t{0});
  const auto jump_m = static_cast<float>(config.occlusion_jump_m);
  const auto ratio = static_cast<float>(config.parallel_beam_ratio);
  const float* r = ring.range_m.data();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const float step = r[i + 1] - r[i];
    if (ring.column[i + 1] - ring.column[i] < kColumnGap) {
      if (step < -jump_m) {  // the farther side lies before the jump
        const std::size_t from = i >= kReach ? i - kReach : 0;
        for (std::size_t k = from; k <= i; ++k) ring.blocked[k] = 1;
      } else if (step > jump_m) {
        for (std::size_t k = i + 1; k < std::min(n, i + kReach + 2); ++k) ring.blocked[k] = 1;
      }
    }
    if (std::abs(r[i - 1] - r[i]) > ratio * r[i] && std::abs(step) > ratio * r[i]) ring.blocked[i] = 1;
  }
}

void block_around(RingSequence& ring, std::size_t picked) noexcept {
  ring.blocked[picked] = 1;
  for (std::size_t k = picked + 1; k < std::min(ring.size, picked + kReach + 1); ++k) {
    if (ring.column[k] - ring.column[k - 1] > kColumnGap) break;
    ring.blocked[k] = 1;
  }
  for (std::size_t k = picked; k > 0 && picked - k < kReach; --k) {
    if (ring.column[k] - ring.column[k - 1] > kColumnGap) break;
    ring.blocked[k - 1] = 1;
  }
}

}  // namespace pago::features
