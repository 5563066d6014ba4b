// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/ground/reference/points.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pago::test {

double Point::azimuth() const {
  const double angle = std::atan2(p.y(), p.x());
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

PointList returns_of(const Sweep& sweep, const Mount& mount) {
  PointList list;
  const Eigen::Matrix3d R = mount.R_level_sensor();
  for (std::size_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3d raw(static_cast<double>(sweep.x_m[i]), static_cast<double>(sweep.y_m[i]),
                              static_cast<double>(sweep.z_m[i]));
    if (raw.allFinite() && !raw.isZero(0.0)) list.push_back({R * raw, i});
  }
  return list;
}

Mask empty_mask(const Sweep& sweep) {
  return Mask(sweep.size, kNonGround);
}

void mark(Mask& mask, const PointList& ground) {
  for (const Point& g : ground) mask[g.index] = kGround;
}

Plane fit(const PointList& points) {
  if (points.size() < 3) return {};
  const double n = static_cast<double>(points.size());
  Plane plane;
  plane.mean.setZero();
  for (const Point& point : points) plane.mean += point.p / n;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Point& point : points) {
    const Eigen::Vector3d d = point.p - plane.mean;
    covariance += d * d.transpose() / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  plane.variance = solver.eigenvalues();
  plane.normal = solver.eigenvectors().col(0);
  if (plane.normal.z() < 0.0) plane.normal = -plane.normal;
  plane.is_valid = plane.variance[2] > 0.0;
  return plane;
}

PointList below(const PointList& points, const Plane& plane, double thickness_m) {
  PointList result;
  for (const Point& point : points)
    if (plane.above(point.p) < thickness_m) result.push_back(point);
  return result;
}

PointList lower_than(const PointList& points, double z_m) {
  PointList result;
  for (const Point& point : points)
    if (point.p.z() < z_m) result.push_back(point);
  return result;
}

double lowest_mean(PointList points, int count, double floor_m) {
  std::erase_if(points, [&](const Point& point) { return point.p.z() < floor_m; });
  std::ranges::stable_sort(points, {}, [](const Point& point) { return point.p.z(); });
  points.resize(std::min(points.size(), static_cast<std::size_t>(count)));
  double sum = 0.0;
  for (const Point& point : points) sum += point.p.z();
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

Plane grow(const PointList& starters,
           const PointList& points,
           double seed_top_m,
           double thickness_m,
           int iterations) {
  PointList members = lower_than(starters, seed_top_m);
  Plane plane;
  for (int i = 0; i < iterations; ++i) {
    plane = fit(members);
    if (!plane.is_valid) return plane;
    members = below(points, plane, thickness_m);
  }
  return plane;
}

ZoneBin zone_bin_of(const Point& point,
                    double near_m,
                    double far_m,
                    const std::array<double, 4>& rings,
                    const std::array<double, 4>& sectors) {
  const double bound[] = {near_m, (7 * near_m + far_m) / 8, (3 * near_m + far_m) / 4, (near_m + far_m) / 2,
                          far_m};
  const double rho = point.range();
  std::size_t zone = 0;
  int inner_rings = 0;
  for (; zone < 3 && rho >= bound[zone + 1]; ++zone) inner_rings += static_cast<int>(rings[zone]);
  const double ring = (rho - bound[zone]) / ((bound[zone + 1] - bound[zone]) / rings[zone]);
  const double sector = point.azimuth() / (2.0 * std::numbers::pi / sectors[zone]);
  return {zone, inner_rings + std::min(static_cast<int>(ring), static_cast<int>(rings[zone]) - 1),
          std::min(static_cast<int>(sector), static_cast<int>(sectors[zone]) - 1)};
}

double share_different(const Sweep& sweep, const Mask& reference) {
  double different = 0.0;
  for (std::size_t i = 0; i < sweep.size; ++i) different += sweep.ground[i] == reference.at(i) ? 0.0 : 1.0;
  return sweep.size == 0 ? 0.0 : different / sweep.size;
}

}  // namespace pago::test
