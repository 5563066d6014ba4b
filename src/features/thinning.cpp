// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/thinning.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pago::features {

namespace {

constexpr std::uint64_t kNone = ~std::uint64_t{0};

/// Bijective on 32 bits: the finalizer of MurmurHash3 (A. Appleby, public domain).
std::uint32_t mix(std::uint32_t x) noexcept {
  x ^= x >> 16;
  x *= 0x85ebca6bU;
  x ^= x >> 13;
  x *= 0xc2b2ae35U;
  return x ^ (x >> 16);
}

/// 21 bits per axis: 2^20 voxels to either side.
std::uint64_t pack(int ix, int iy, int iz) noexcept {
  constexpr int kOffset = 1 << 20;
  const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i + kOffset)); };
  return bits(ix) << 42 | bits(iy) << 21 | bits(iz);
}

int floor_to_int(float x) noexcept {
  return static_cast<int>(std::floor(x));
}

}  // namespace

// Slots are at most half full, so that probes stay short.
VoxelThinner::VoxelThinner(double voxel_m, std::uint32_t max_voxels)
    : per_voxel_(static_cast<float>(1.0 / voxel_m)),
      mask_(std::bit_ceil(2 * max_voxels) - 1),
      shift_(64 - std::countr_one(mask_)),
      slots_(mask_ + 1, Slot{kNone, 0, 0}),
      occupied_(max_voxels) {}

void VoxelThinner::begin(std::uint32_t seed) noexcept {
  seed_ = mix(seed);
  for (const std::uint32_t slot : occupied_) slots_[slot].voxel = kNone;
  occupied_.clear();
}

void VoxelThinner::offer(float x_m, float y_m, float z_m, std::uint32_t index) noexcept {
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio: spreads neighbours
  const std::uint64_t voxel =
      pack(floor_to_int(x_m * per_voxel_), floor_to_int(y_m * per_voxel_), floor_to_int(z_m * per_voxel_));
  const std::uint32_t rank = mix(index ^ seed_);
  for (auto at = static_cast<std::uint32_t>(voxel * kGolden >> shift_);; at = (at + 1) & mask_) {
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
      dense_(config.dense_voxel_m, std::min(max_returns, kMaxDensePoints)),
      map_(config.map_voxel_m, std::min(max_returns, kMaxMapPoints)),
      key_(config.key_voxel_m, std::min(max_returns, kMaxMapPoints)),
      candidates_(std::min(max_returns, kMaxMapPoints)) {}

// Another choice in each sweep: a standing sensor sees the same returns under the same indices again.
void SweepThinner::begin(const Sweep& sweep) noexcept {
  const auto seed = static_cast<std::uint32_t>(3 * sweep.header.sequence);
  accepted_ = 0;
  dense_.begin(seed);
  map_.begin(seed + 1);
  key_.begin(seed + 2);
}

void SweepThinner::accept(const Sweep& sweep, std::uint32_t until) noexcept {
  for (; accepted_ < until; ++accepted_) {
    const std::uint32_t i = accepted_;
    const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
    const float range_sq = x * x + y * y + z * z;
    // Written so that NaN is left out.
    if (range_sq >= min_range_sq_ && range_sq <= max_range_sq_) dense_.offer(x, y, z, i);
  }
}

void SweepThinner::finish(Sweep& sweep) noexcept {
  FeatureLists& lists = sweep.features;
  const auto offer_to = [&sweep](VoxelThinner& thinner, std::uint32_t i) {
    thinner.offer(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i], i);
  };
  for (std::size_t n = 0; n < dense_.size(); ++n) {
    lists.dense.push_back(dense_.chosen(n));
    offer_to(map_, dense_.chosen(n));
  }
  for (std::size_t n = 0; n < map_.size(); ++n) {
    lists.map_points.push_back(map_.chosen(n));
    offer_to(key_, map_.chosen(n));
  }
  pick_key_points(lists);
}

// Those of lowest rank: any subset by rank is a random one. In the order of their indices, as memory likes it.
void SweepThinner::pick_key_points(FeatureLists& lists) noexcept {
  candidates_.clear();
  for (std::size_t n = 0; n < key_.size(); ++n) candidates_.push_back({key_.rank(n), key_.chosen(n)});
  const std::size_t wanted =
      std::min({candidates_.size(), lists.key_points.capacity(), static_cast<std::size_t>(config_.key_points)});
  std::nth_element(candidates_.begin(), candidates_.begin() + wanted, candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rank < b.rank; });
  candidates_.truncate(wanted);
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
  for (const Candidate& candidate : candidates_) lists.key_points.push_back(candidate.index);
}

}  // namespace pago::features
