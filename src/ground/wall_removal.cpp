// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "wall_removal.hpp"

namespace pago::ground {

WallRemoval::WallRemoval(const WallRule& rule, std::size_t max_points)
    : rule_(rule), lowest_mean_(max_points), x_m_(max_points), y_m_(max_points), z_m_(max_points) {}

Points WallRemoval::operator()(
    const Points& points, float floor_m, float x_m, float y_m, FixedVector<Slab>& walls) noexcept {
  const auto count = static_cast<std::size_t>(rule_.lowest_points);
  Points rest = points;
  for (int i = 0; i < rule_.max_walls; ++i) {
    const double lowest_m = lowest_mean_(rest.z_m, count, floor_m).value_or(0.0);
    const auto seeds = HalfSpace::below_height(static_cast<float>(lowest_m + rule_.seed_height_m));
    const PlaneFit plane =
        fit_plane(statistics_inside(rest, seeds, {x_m, y_m, static_cast<float>(lowest_m)}));
    if (!plane.is_valid || !(plane.normal.z() < rule_.min_uprightness)) break;
    const Slab wall = plane.around(rule_.reach_m);
    walls.push_back(wall);
    rest = without(rest, wall);
  }
  return rest;
}

/// May be given what it has returned before: it never writes ahead of where it reads.
Points WallRemoval::without(const Points& points, const Slab& wall) noexcept {
  std::size_t size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float x = points.x_m[i], y = points.y_m[i], z = points.z_m[i];
    x_m_[size] = x;
    y_m_[size] = y;
    z_m_[size] = z;
    size += wall.holds(x, y, z) ? 0U : 1U;
  }
  return {x_m_.first(size), y_m_.first(size), z_m_.first(size)};
}

}  // namespace pago::ground
