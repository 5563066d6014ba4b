// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plane_grower.hpp"

namespace pago::ground {

PlaneFit PlaneGrower::operator()(
    const Points& starters, const Points& points, float floor_m, float x_m, float y_m) noexcept {
  const auto count = static_cast<std::size_t>(rule_.lowest_points);
  const double lowest_m = lowest_mean_(starters.z_m, count, floor_m).value_or(0.0);
  const Eigen::Vector3f origin(x_m, y_m, static_cast<float>(lowest_m));
  const auto seeds = HalfSpace::below_height(static_cast<float>(lowest_m + rule_.seed_height_m));
  PlaneFit plane = fit_plane(statistics_inside(starters, seeds, origin));
  for (int i = 1; i < rule_.iterations && plane.is_valid; ++i)
    plane = fit_plane(statistics_inside(points, plane.below(rule_.ground_thickness_m), origin));
  return plane;
}

}  // namespace pago::ground
