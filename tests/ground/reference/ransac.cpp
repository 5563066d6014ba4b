// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/ground/random.hpp"
#include "tests/ground/reference/points.hpp"

namespace pago::test {

Plane ransac(const PointList& points,
             double distance_m,
             int max_iterations,
             double confidence,
             double min_uprightness,
             std::uint64_t seed) {
  if (points.size() < 3) return {};
  ground::Random random(seed);
  PointList best;
  double needed = max_iterations;
  for (int tried = 0; tried < max_iterations && tried < needed; ++tried) {
    const Eigen::Vector3d a = points[random.below(points.size())].p;
    const Eigen::Vector3d b = points[random.below(points.size())].p;
    const Eigen::Vector3d c = points[random.below(points.size())].p;
    const Eigen::Vector3d across = (b - a).cross(c - a);
    if (!(across.norm() > 1e-6)) continue;
    const Eigen::Vector3d normal = across / across.norm();
    if (std::abs(normal.z()) < min_uprightness) continue;
    PointList inliers;
    for (const Point& point : points)
      if (std::abs(normal.dot(point.p - a)) < distance_m) inliers.push_back(point);
    if (inliers.size() <= best.size()) continue;
    best = inliers;
    const double share = static_cast<double>(best.size()) / static_cast<double>(points.size());
    needed = std::log(1.0 - confidence) / std::log(1.0 - share * share * share);
  }
  return fit(best);
}

Reference ransac_reference(const RansacConfig& c, const Mount& mount) {
  return [c, mount](const Sweep& sweep) {
    const PointList points = returns_of(sweep, mount);
    const Plane plane =
        ransac(points, c.inlier_distance_m, c.max_iterations, c.confidence,
               std::cos(c.max_tilt_deg * std::numbers::pi / 180.0), static_cast<std::uint64_t>(c.seed));
    Mask mask = empty_mask(sweep);
    if (plane.is_valid) mark(mask, below(points, plane, std::max(c.ground_thickness_m, c.inlier_distance_m)));
    return mask;
  };
}

}  // namespace pago::test
