// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/config/features.hpp"
#include "pago/core/sweep.hpp"

namespace pago::features {

/// A draw per index, uniform over 32 bits: the finalizer of MurmurHash3 (A. Appleby, public domain),
/// bijective. Choosing by it is as good as choosing at random, and the same for every order and partition of
/// the returns.
inline std::uint32_t draw(std::uint32_t index, std::uint32_t seed) noexcept {
  std::uint32_t x = index ^ seed;
  x ^= x >> 16;
  x *= 0x85ebca6bU;
  x ^= x >> 13;
  x *= 0xc2b2ae35U;
  return x ^ (x >> 16);
}

/// Keeps returns along a ring about `spacing_m` apart on average, whatever their range: each with a
/// probability that grows with it. Which ones does not depend on the returns' noise. (Keeping those that are
/// far enough from the last one kept would prefer ranges that are too long on one half of each surface and
/// too short on the other, and turn it: seen as 15 mdeg of yaw per sweep.)
class SpacingSampler {
 public:
  SpacingSampler(double spacing_m, std::uint32_t columns, std::uint32_t seed) noexcept;

  bool keeps(std::uint32_t index, float range_sq_m2) const noexcept {
    const float u = static_cast<float>(draw(index, seed_)) * 0x1p-32F;
    return u * u < range_sq_m2 * per_range_sq_;
  }

 private:
  float per_range_sq_;  // squared probability of being kept, per square metre of range
  std::uint32_t seed_;
};

/// Keeps one point of each cubic voxel, drawn at random. (The first one of each would be biased: returns come
/// ring by ring or firing by firing; measured in spec/odometry-prototype.md section 4.7.)
///
/// [set-up] constructor; [one thread] the rest: real-time safe, deterministic.
class VoxelThinner {
 public:
  /// `max_voxels` occupied ones at most; points in voxels beyond that are left out, and so are those beyond
  /// 512 voxels (1,024 in plan) from the origin.
  VoxelThinner(double voxel_m, std::uint32_t max_voxels);

  /// Forgets everything. `seed` picks another choice, and shifts the grid: a surface that lies along a
  /// boundary of voxels would otherwise be thinned unevenly in every sweep.
  void begin(std::uint32_t seed) noexcept;
  void offer(float x_m, float y_m, float z_m, std::uint32_t index) noexcept;

  std::size_t size() const noexcept { return occupied_.size(); }
  /// The chosen point of the i-th voxel, in the order of the voxels' first points.
  std::uint32_t chosen(std::size_t i) const noexcept { return slots_[occupied_[i]].index; }
  /// The draw that chose it.
  std::uint32_t rank(std::size_t i) const noexcept { return slots_[occupied_[i]].rank; }

 private:
  struct Slot {
    std::uint32_t voxel = 0, rank = 0, index = 0;
  };

  float per_voxel_;
  std::uint32_t seed_ = 0, mask_;
  float shift_x_ = 0.0F, shift_y_ = 0.0F, shift_z_ = 0.0F;  // voxels
  int hash_shift_;
  AlignedArray<Slot> slots_;
  FixedVector<std::uint32_t> occupied_;  // positions in slots_
};

/// Thins a whole sweep for mapping: sweep.features.dense (what a saved map shows), of these .map_points (what
/// the local map is made of), of these .key_points (what is registered). Ground and clutter alike: how a
/// return was classified does not matter here, so this work can be done while the sweep still arrives.
class SweepThinner {
 public:
  SweepThinner(const ThinningConfig& config, std::uint32_t max_returns);

  void begin(const Sweep& sweep) noexcept;
  /// Returns [those accepted before, until).
  void accept(Sweep& sweep, std::uint32_t until) noexcept;
  void finish(Sweep& sweep) noexcept;

 private:
  struct Candidate {
    std::uint32_t rank = 0, index = 0;
  };

  void pick_key_points(FeatureLists& lists) noexcept;

  ThinningConfig config_;
  float min_range_sq_, max_range_sq_;
  VoxelThinner map_, key_;
  std::uint32_t accepted_ = 0, seed_ = 0;
  FixedVector<Candidate> candidates_;
};

}  // namespace pago::features
