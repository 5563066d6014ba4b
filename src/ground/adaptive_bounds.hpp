// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "pago/config/ground/patchworkpp.hpp"
#include "pago/core/aligned_array.hpp"

namespace pago::ground {

/// Of some numbers; the deviation is the sample's (divided by n - 1), 0 for fewer than two.
struct MeanDeviation {
  double mean = 0.0, deviation = 0.0;
};
MeanDeviation mean_and_deviation(std::span<const double> numbers) noexcept;

/// The latest so many numbers.
class Recent {
 public:
  /// [set-up] allocates.
  explicit Recent(std::size_t capacity) : numbers_(capacity) {}

  void add(double number) noexcept;
  void clear() noexcept { next_ = size_ = 0; }
  std::span<const double> numbers() const noexcept { return numbers_.first(size_); }

 private:
  AlignedArray<double> numbers_;
  std::size_t next_ = 0, size_ = 0;
};

/// What Patchwork++ learns from sweep to sweep (A-GLE): how high and how uneven the ground of the four inner
/// rings is, and how high the sensor. [front thread] everything but the constructor; real-time safe.
class AdaptiveBounds {
 public:
  static constexpr int kRings = 4;

  /// [set-up] Allocates.
  AdaptiveBounds(const PatchworkppConfig& config, double height_m);

  /// Forgets everything. `height_m`: of the mount.
  void reset(double height_m) noexcept;

  /// Of the sensor above the ground; never farther from the mount's than max_height_change_m.
  double height_m() const noexcept { return height_m_; }
  /// Bounds in the sensor frame; on z within max_elevation_m of the ground as the mount has it.
  double max_z_m(int ring) const noexcept { return rings_[index(ring)].max_z_m; }
  double max_flatness_m2(int ring) const noexcept { return rings_[index(ring)].max_flatness_m2; }

  /// A plane of this sweep that was found low enough.
  void note(int ring, double z_m, double flatness_m2) noexcept;

  /// At a sweep's end: new bounds for the next.
  void learn() noexcept;

 private:
  struct Ring {
    explicit Ring(std::size_t memory) : z_m(memory), flatness_m2(memory) {}
    Recent z_m, flatness_m2;
    double max_z_m = 0.0, max_flatness_m2 = 0.0;
  };
  static std::size_t index(int ring) noexcept { return static_cast<std::size_t>(ring); }

  PatchworkppConfig config_;
  double mount_height_m_ = 0.0, height_m_ = 0.0;
  std::array<Ring, kRings> rings_;
};

}  // namespace pago::ground
