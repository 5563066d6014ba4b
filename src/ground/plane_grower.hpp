// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "lowest_mean.hpp"
#include "plane_fit.hpp"

namespace pago::ground {

struct GrowthRule {
  int lowest_points = 20;           ///< whose mean height is where to begin
  double seed_height_m = 0.5;       ///< points less than this above it start the plane
  double ground_thickness_m = 0.1;  ///< points less than this above the plane belong to it, and all below it
  int iterations = 3;               ///< fits
};

/// Out of a method's settings, which name these four alike.
template <typename MethodConfig>
GrowthRule growth_rule(const MethodConfig& config) {
  return {config.lowest_points, config.seed_height_m, config.ground_thickness_m, config.iterations};
}

/// Ground plane fitting after Zermas 2017, the core of several methods: a plane through what is not much
/// higher than the lowest points, then again and again through everything that is not above the plane.
class PlaneGrower {
 public:
  static constexpr float kNoFloor = -std::numeric_limits<float>::infinity();

  /// [set-up] For up to `max_points`; allocates.
  PlaneGrower(const GrowthRule& rule, std::size_t max_points) : rule_(rule), lowest_mean_(max_points) {}

  /// [front thread] The last plane that was fitted. Points lower than `floor_m` are passed over among the
  /// lowest, but start the plane with the others, as in the authors' codes. `x_m`, `y_m`: amid the points.
  /// Real-time safe.
  PlaneFit operator()(const Points& points, float floor_m, float x_m, float y_m) noexcept {
    return (*this)(points, points, floor_m, x_m, y_m);
  }
  /// The same where only some of the points may start the plane.
  PlaneFit operator()(
      const Points& starters, const Points& points, float floor_m, float x_m, float y_m) noexcept;

 private:
  GrowthRule rule_;
  LowestMean lowest_mean_;
};

}  // namespace pago::ground
