// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>

#include "points.hpp"

namespace pago::ground {

/// All points p with normal . p < offset_m.
struct HalfSpace {
  float normal_x = 0.0F, normal_y = 0.0F, normal_z = 1.0F;
  float offset_m = 0.0F;

  static HalfSpace below_height(float height_m) { return {0.0F, 0.0F, 1.0F, height_m}; }
  static HalfSpace nothing() { return {0.0F, 0.0F, 0.0F, -std::numeric_limits<float>::infinity()}; }

  bool holds(float x_m, float y_m, float z_m) const noexcept {
    return normal_x * x_m + normal_y * y_m + normal_z * z_m < offset_m;
  }
};

/// All points p with lower_m < normal . p < upper_m.
struct Slab {
  float normal_x = 0.0F, normal_y = 0.0F, normal_z = 1.0F;
  float lower_m = 0.0F, upper_m = 0.0F;

  /// Everything less than `reach_m` on either side of the plane normal . p = offset_m.
  static Slab around(const Eigen::Vector3d& normal, double offset_m, double reach_m);

  bool holds(float x_m, float y_m, float z_m) const noexcept {
    const float along_m = normal_x * x_m + normal_y * y_m + normal_z * z_m;
    return (lower_m < along_m) & (along_m < upper_m);
  }
};

/// How many points, and their mean and covariance (divided by the number of points).
struct PointStatistics {
  double count = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of the points inside. The sums are taken about `origin`, in float: choose it near the
/// points (a few metres away the covariance is good to 1e-5 m^2). No point may be infinite.
PointStatistics statistics_inside(const Points& points,
                                  const HalfSpace& inside,
                                  const Eigen::Vector3f& origin) noexcept;
PointStatistics statistics_inside(const Points& points,
                                  const Slab& inside,
                                  const Eigen::Vector3f& origin) noexcept;

std::size_t count_inside(const Points& points, const Slab& slab) noexcept;

/// The plane with the least squared distances to some points.
struct PlaneFit {
  bool is_valid = false;  ///< false for fewer than three points, or all in one place
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of length 1, never pointing downwards
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  ///< along the principal axes, ascending; m^2

  /// Part of the variance that is across the plane: 0 flat, 1/3 no plane at all.
  double surface_variation() const noexcept { return variance[0] / variance.sum(); }

  /// Everything less than `thickness_m` above the plane.
  HalfSpace below(double thickness_m) const noexcept;
  /// Not finite for an upright plane.
  double height_at(const Eigen::Vector2d& xy) const noexcept {
    return mean.z() - normal.head<2>().dot(xy - mean.head<2>()) / normal.z();
  }
  /// Everything less than `reach_m` above or below it.
  Slab around(double reach_m) const noexcept { return Slab::around(normal, normal.dot(mean), reach_m); }
};

PlaneFit fit_plane(const PointStatistics& points) noexcept;

}  // namespace pago::ground
