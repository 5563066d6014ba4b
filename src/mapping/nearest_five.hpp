// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "pago/registration/kd_tree.hpp"

namespace pago::mapping {

using FivePoints = std::array<Eigen::Vector3d, 5>;

/// The five points nearest to `query`, if even the fifth is within `radius_m`.
std::optional<FivePoints> nearest_five(const registration::KdTree& tree,
                                       const Eigen::Vector3d& query,
                                       double radius_m);

/// The line that five edges are on: through their mean, along their greatest spread; none unless its variance
/// is more than three times the next one. (LOAM's mapping.)
struct FiveLine {
  Eigen::Vector3d centre, direction;
};
std::optional<FiveLine> line_through(const FivePoints& points) noexcept;

/// The plane n . x = distance_m that fits five points by least squares in n . x = -1, none if one of them is
/// more than 0.2 m off it. (LOAM's mapping. The fit is poor where the plane goes near the origin of the map.)
struct FivePlane {
  Eigen::Vector3d normal;
  double distance_m;
};
std::optional<FivePlane> plane_through(const FivePoints& points) noexcept;

}  // namespace pago::mapping
