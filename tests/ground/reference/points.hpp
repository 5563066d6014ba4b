// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tests/ground/reference/reference.hpp"

/// What the references share.
namespace pago::test {

struct Point {
  Eigen::Vector3d p;  ///< levelled
  std::size_t index;  ///< in the sweep
  double range() const { return std::hypot(p.x(), p.y()); }
  /// From the x axis to the left, [0, 2 pi).
  double azimuth() const;
};
using PointList = std::vector<Point>;

/// The returns that are finite and not zero.
PointList returns_of(const Sweep& sweep, const Mount& mount);

Mask empty_mask(const Sweep& sweep);
void mark(Mask& mask, const PointList& ground);

struct Plane {
  bool is_valid = false;
  Eigen::Vector3d normal, mean,
      variance;  ///< normal up; variances ascending, divided by the number of points
  double above(const Eigen::Vector3d& p) const { return normal.dot(p - mean); }
};
Plane fit(const PointList& points);

PointList below(const PointList& points, const Plane& plane, double thickness_m);
PointList lower_than(const PointList& points, double z_m);

/// Mean height of the `count` lowest that are not lower than `floor_m`; 0 of none.
double lowest_mean(PointList points, int count, double floor_m);

/// Ground plane fitting: the plane after `iterations` fits.
Plane grow(const PointList& starters,
           const PointList& points,
           double seed_top_m,
           double thickness_m,
           int iterations);

/// Zone, ring counted over all zones, sector.
struct ZoneBin {
  std::size_t zone;
  int ring, sector;
  auto operator<=>(const ZoneBin&) const = default;
};
ZoneBin zone_bin_of(const Point& point,
                    double near_m,
                    double far_m,
                    const std::array<double, 4>& rings,
                    const std::array<double, 4>& sectors);

/// The plane that most points lie on, by the same random samples as the method's.
Plane ransac(const PointList& points,
             double distance_m,
             int max_iterations,
             double confidence,
             double min_uprightness,
             std::uint64_t seed);

}  // namespace pago::test
