// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "pago/odometry/grid_index.hpp"

namespace pago::odometry {

/// A feature of this sweep and what it should lie on in the last one.
struct Match {
  Eigen::Vector3d source;  ///< in the current sensor frame
  Eigen::Vector3d centre;  ///< a point of the plane or line, in the previous sensor frame
  Eigen::Vector3d axis;    ///< the plane's unit normal, or the line's unit direction
  double variance_m2;      ///< of the points that the plane or line was made from, off it
};

/// The plane through the neighbours of `query` on the nearest feature's ring and on the rings next to it
/// (LOAM section V.B: two points of a ring and one of the next; `per_ring` of each, up to three, make the
/// normal less noisy). Empty if nothing is within `radius_m`, or the neighbours lie on one line or on no
/// plane.
struct Plane {
  Eigen::Vector3d centre, normal;
  double variance_m2;
};
std::optional<Plane> find_plane(const GridIndex& target,
                                const Eigen::Vector3f& query,
                                float radius_m,
                                int per_ring = 3) noexcept;

/// The line through the nearest edge feature and its neighbours on other rings (LOAM section V.B).
struct Line {
  Eigen::Vector3d centre, direction;
  double variance_m2;
};
std::optional<Line> find_line(const GridIndex& target, const Eigen::Vector3f& query, float radius_m) noexcept;

}  // namespace pago::odometry
