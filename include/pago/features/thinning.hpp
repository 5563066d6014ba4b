// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/config/features.hpp"
#include "pago/core/sweep.hpp"

namespace pago::features {

/// Keeps one return of each cubic voxel about the sensor, chosen by a hash of its index: as good as at random,
/// and the same for every order and partition of the returns. (The first one of each voxel would be biased:
/// returns come ring by ring or firing by firing; measured in spec/odometry-prototype.md section 4.7.)
///
/// [set-up] constructor; [one thread] the rest: real-time safe, deterministic.
class VoxelThinner {
 public:
  /// `max_voxels` occupied ones at most; returns in voxels beyond that are left out.
  VoxelThinner(double voxel_m, std::uint32_t max_voxels);

  /// Forgets everything; `seed` picks another choice.
  void begin(std::uint32_t seed) noexcept;
  void offer(float x_m, float y_m, float z_m, std::uint32_t index) noexcept;

  std::size_t size() const noexcept { return occupied_.size(); }
  /// The chosen return of the i-th voxel, in the order of the voxels' first returns.
  std::uint32_t chosen(std::size_t i) const noexcept { return slots_[occupied_[i]].index; }
  /// The hash that chose it: uniform over 32 bits.
  std::uint32_t rank(std::size_t i) const noexcept { return slots_[occupied_[i]].rank; }

 private:
  struct Slot {
    std::uint64_t voxel = 0;
    std::uint32_t rank = 0, index = 0;
  };

  float per_voxel_;
  std::uint32_t seed_ = 0, mask_;
  int shift_;
  AlignedArray<Slot> slots_;
  FixedVector<std::uint32_t> occupied_;  // positions in slots_
};

/// Thins a whole sweep for mapping: sweep.features.dense (what a saved map shows), of these .map_points (what
/// the local map is made of), of these .key_points (what is registered). Ground and clutter alike: how a return
/// was classified does not matter here, so this work can be done while the sweep still arrives.
class SweepThinner {
 public:
  SweepThinner(const ThinningConfig& config, std::uint32_t max_returns);

  void begin(const Sweep& sweep) noexcept;
  /// Returns [those accepted before, until).
  void accept(const Sweep& sweep, std::uint32_t until) noexcept;
  void finish(Sweep& sweep) noexcept;

 private:
  void pick_key_points(FeatureLists& lists) noexcept;

  ThinningConfig config_;
  float min_range_sq_, max_range_sq_;
  VoxelThinner dense_, map_, key_;
  std::uint32_t accepted_ = 0;
  struct Candidate {
    std::uint32_t rank = 0, index = 0;
  };
  FixedVector<Candidate> candidates_;
};

}  // namespace pago::features
