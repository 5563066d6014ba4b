// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace pago::ground {

PointStatistics statistics_inside(const BinPoints& points,
                                  const HalfSpace& inside,
                                  const Eigen::Vector3f& origin) noexcept {
  const float* const px = points.x_m.data();
  const float* const py = points.y_m.data();
  const float* const pz = points.z_m.data();
  const float ox = origin.x(), oy = origin.y(), oz = origin.z();
  const HalfSpace h = inside;
  float n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  // The weights keep the loop free of branches; points outside add nothing.
#pragma omp simd reduction(+ : n, x, y, z, xx, xy, xz, yy, yz, zz)
  for (std::size_t i = 0; i < points.z_m.size(); ++i) {
    const float along = h.normal_x * px[i] + h.normal_y * py[i] + h.normal_z * pz[i];
    const float w = along < h.offset_m ? 1.0F : 0.0F;
    const float dx = px[i] - ox, dy = py[i] - oy, dz = pz[i] - oz;
    const float wx = w * dx, wy = w * dy, wz = w * dz;
    n += w;
    x += wx;
    y += wy;
    z += wz;
    xx += wx * dx;
    xy += wx * dy;
    xz += wx * dz;
    yy += wy * dy;
    yz += wy * dz;
    zz += wz * dz;
  }

  PointStatistics result;
  result.count = static_cast<double>(n);
  if (n < 1.0F) return result;
  const Eigen::Vector3d offset = Eigen::Vector3f(x, y, z).cast<double>() / result.count;
  Eigen::Matrix3f second;
  second << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  result.mean = origin.cast<double>() + offset;
  result.covariance = second.cast<double>() / result.count - offset * offset.transpose();
  return result;
}

HalfSpace PlaneFit::below(double thickness_m) const noexcept {
  const Eigen::Vector3f n = normal.cast<float>();
  return {n.x(), n.y(), n.z(), static_cast<float>(normal.dot(mean) + thickness_m)};
}

PlaneFit fit_plane(const PointStatistics& points) noexcept {
  PlaneFit fit;
  if (!(points.count >= 3.0) || !points.covariance.allFinite()) return fit;

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(points.covariance);
  // The closed form loses the normal where the points lie on a line; the iteration does not.
  constexpr double kLine = 1e-6;
  const Eigen::Vector3d& w = solver.eigenvalues();
  if (!(w[1] - w[0] > kLine * w[2])) solver.compute(points.covariance);
  if (!(w[2] > 0.0) || !solver.eigenvectors().allFinite()) return fit;

  fit.is_valid = true;
  fit.mean = points.mean;
  fit.variance = w.cwiseMax(0.0);
  fit.normal = solver.eigenvectors().col(0);
  if (fit.normal.z() < 0.0) fit.normal = -fit.normal;
  return fit;
}

}  // namespace pago::ground
