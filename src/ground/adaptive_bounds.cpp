// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace pago::ground {

MeanDeviation mean_and_deviation(std::span<const double> numbers) noexcept {
  MeanDeviation result;
  if (numbers.empty()) return result;
  const double n = static_cast<double>(numbers.size());
  for (const double number : numbers) result.mean += number / n;
  if (numbers.size() < 2) return result;
  double sum_sq = 0.0;
  for (const double number : numbers) sum_sq += (number - result.mean) * (number - result.mean);
  result.deviation = std::sqrt(sum_sq / (n - 1.0));
  return result;
}

void Recent::add(double number) noexcept {
  numbers_[next_] = number;
  next_ = (next_ + 1) % numbers_.size();
  size_ = std::min(size_ + 1, numbers_.size());
}

AdaptiveBounds::AdaptiveBounds(const PatchworkppConfig& config, double height_m)
    : config_(config),
      rings_{Ring(static_cast<std::size_t>(config.memory)), Ring(static_cast<std::size_t>(config.memory)),
             Ring(static_cast<std::size_t>(config.memory)), Ring(static_cast<std::size_t>(config.memory))} {
  reset(height_m);
}

void AdaptiveBounds::reset(double height_m) noexcept {
  mount_height_m_ = height_m_ = height_m;
  for (Ring& ring : rings_) {
    ring.z_m.clear();
    ring.flatness_m2.clear();
    ring.max_z_m = config_.max_elevation_m - height_m;
    ring.max_flatness_m2 = 0.0;
  }
}

void AdaptiveBounds::note(int ring, double z_m, double flatness_m2) noexcept {
  rings_[index(ring)].z_m.add(z_m);
  rings_[index(ring)].flatness_m2.add(flatness_m2);
}

/// Bounds at two standard deviations of the heights (three in the innermost ring), one of the flatness. What
/// is below a bound is what it is learnt from: unbounded, it would rise by itself.
void AdaptiveBounds::learn() noexcept {
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    Ring& ring = rings_[i];
    if (ring.z_m.numbers().empty()) continue;
    const MeanDeviation z = mean_and_deviation(ring.z_m.numbers());
    ring.max_z_m =
        std::clamp(z.mean + (i == 0 ? 3.0 : 2.0) * z.deviation, -mount_height_m_ - config_.max_elevation_m,
                   -mount_height_m_ + config_.max_elevation_m);
    if (i == 0)
      height_m_ = std::clamp(-z.mean, mount_height_m_ - config_.max_height_change_m,
                             mount_height_m_ + config_.max_height_change_m);
    if (ring.flatness_m2.numbers().size() < 2) continue;
    const MeanDeviation flatness = mean_and_deviation(ring.flatness_m2.numbers());
    ring.max_flatness_m2 = flatness.mean + flatness.deviation;
  }
}

}  // namespace pago::ground
