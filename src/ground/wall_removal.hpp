// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lowest_mean.hpp"
#include "plane_fit.hpp"

namespace pago::ground {

struct WallRule {
  int lowest_points = 20;
  double seed_height_m = 0.25;
  double reach_m = 0.1;  ///< from a wall to the returns that are on it
  double min_uprightness = 0.707;
  int max_walls = 3;
};

/// Patchwork++'s vertical plane fitting (R-VPF): as long as the plane through a bin's low points is upright
/// like a wall, what lies on it is taken out.
class WallRemoval {
 public:
  /// [set-up] For up to `max_points`; allocates.
  WallRemoval(const WallRule& rule, std::size_t max_points);

  /// [front thread] The points that are left, valid until the next call, and appends the walls to `walls`.
  /// Points lower than `floor_m` are passed over among the lowest. Real-time safe.
  Points operator()(
      const Points& points, float floor_m, float x_m, float y_m, FixedVector<Slab>& walls) noexcept;

 private:
  Points without(const Points& points, const Slab& wall) noexcept;

  WallRule rule_;
  LowestMean lowest_mean_;
  AlignedArray<float> x_m_, y_m_, z_m_;
};

}  // namespace pago::ground
