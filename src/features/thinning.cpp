// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/thinning.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace pago::features {

namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// 11 bits for x and y, 10 for z.
std::uint32_t pack(int ix, int iy, int iz) noexcept {
  const auto bits = [](int i, int width) {
    return (static_cast<std::uint32_t>(i) + (1U << (width - 1))) & ((1U << width) - 1);
  };
  return bits(ix, 11) << 21 | bits(iy, 11) << 10 | bits(iz, 10);
}

int floor_to_int(float x) noexcept {
  return static_cast<int>(std::floor(x));
}

/// Nominal firings of a rotation: what is not known before the sweep's end.
constexpr std::uint32_t kNominalColumns = 2083;

}  // namespace

SpacingSampler::SpacingSampler(double spacing_m, std::uint32_t columns, std::uint32_t seed) noexcept
    : seed_(draw(0, seed)) {
  const double per_range = 2.0 * std::numbers::pi / (std::max(1U, columns) * spacing_m);
  per_range_sq_ = static_cast<float>(per_range * per_range);
}

// Slots are at most half full, so that probes stay short.
VoxelThinner::VoxelThinner(double voxel_m, std::uint32_t max_voxels)
    : per_voxel_(static_cast<float>(1.0 / voxel_m)),
      mask_(std::bit_ceil(2 * max_voxels) - 1),
      hash_shift_(32 - std::countr_one(mask_)),
      slots_(mask_ + 1, Slot{kNone, 0, 0}),
      occupied_(max_voxels) {}

void VoxelThinner::begin(std::uint32_t seed) noexcept {
  const auto part = [seed](std::uint32_t axis) { return static_cast<float>(draw(axis, seed)) * 0x1p-32F; };
  seed_ = draw(0, seed);
  shift_x_ = part(1), shift_y_ = part(2), shift_z_ = part(3);
  for (const std::uint32_t slot : occupied_) slots_[slot].voxel = kNone;
  occupied_.clear();
}

void VoxelThinner::offer(float x_m, float y_m, float z_m, std::uint32_t index) noexcept {
  constexpr std::uint32_t kGolden = 0x9e3779b9U;  // 2^32 / golden ratio: spreads neighbours
  const std::uint32_t voxel =
      pack(floor_to_int(x_m * per_voxel_ + shift_x_), floor_to_int(y_m * per_voxel_ + shift_y_),
           floor_to_int(z_m * per_voxel_ + shift_z_));
  const std::uint32_t rank = draw(index, seed_);
  for (std::uint32_t at = voxel * kGolden >> hash_shift_;; at = (at + 1) & mask_) {
    Slot& slot = slots_[at];
    if (slot.voxel == voxel) {
      if (rank < slot.rank) slot.rank = rank, slot.index = index;
      return;
    }
    if (slot.voxel == kNone) {
      if (occupied_.push_back(at)) slot = {voxel, rank, index};
      return;
    }
  }
}

SweepThinner::SweepThinner(const ThinningConfig& config, std::uint32_t max_returns)
    : config_(config),
      min_range_sq_(static_cast<float>(config.min_range_m * config.min_range_m)),
      max_range_sq_(static_cast<float>(config.max_range_m * config.max_range_m)),
      map_(config.map_voxel_m, std::min(max_returns, kMaxMapPoints)),
      key_(config.key_voxel_m, std::min(max_returns, kMaxMapPoints)),
      candidates_(std::min(max_returns, kMaxMapPoints)) {}

// Another choice in each sweep: a standing sensor sees the same returns under the same indices again.
void SweepThinner::begin(const Sweep& sweep) noexcept {
  accepted_ = 0;
  seed_ = static_cast<std::uint32_t>(3 * sweep.header.sequence);
  map_.begin(seed_ + 1);
  key_.begin(seed_ + 2);
}

void SweepThinner::accept(Sweep& sweep, std::uint32_t until) noexcept {
  const SpacingSampler sampler(config_.dense_spacing_m, kNominalColumns, seed_);
  for (; accepted_ < until; ++accepted_) {
    const std::uint32_t i = accepted_;
    const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
    const float range_sq = x * x + y * y + z * z;
    // Written so that NaN is left out.
    if (!(range_sq >= min_range_sq_ && range_sq <= max_range_sq_) || !sampler.keeps(i, range_sq)) continue;
    if (sweep.features.dense.push_back(i)) map_.offer(x, y, z, i);
  }
}

void SweepThinner::finish(Sweep& sweep) noexcept {
  FeatureLists& lists = sweep.features;
  for (std::size_t n = 0; n < map_.size(); ++n) {
    const std::uint32_t i = map_.chosen(n);
    lists.map_points.push_back(i);
    key_.offer(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i], i);
  }
  pick_key_points(lists);
}

// Those of lowest rank: any subset by rank is a random one. In the order of their indices, as memory likes
// it.
void SweepThinner::pick_key_points(FeatureLists& lists) noexcept {
  candidates_.clear();
  for (std::size_t n = 0; n < key_.size(); ++n) candidates_.push_back({key_.rank(n), key_.chosen(n)});
  const std::size_t wanted = std::min(
      {candidates_.size(), lists.key_points.capacity(), static_cast<std::size_t>(config_.key_points)});
  std::nth_element(candidates_.begin(), candidates_.begin() + wanted, candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rank < b.rank; });
  candidates_.truncate(wanted);
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
  for (const Candidate& candidate : candidates_) lists.key_points.push_back(candidate.index);
}

}  // namespace pago::features
