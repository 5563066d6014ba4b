// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "float8.hpp"

namespace pago::ground {
namespace {

/// Which of eight points are inside: -1, else 0; also for NaNs.
void find_inside(const HalfSpace& h, const Float8& x, const Float8& y, const Float8& z, Int8& is_inside) {
  is_inside = h.normal_x * x + h.normal_y * y + h.normal_z * z < h.offset_m;
}
void find_inside(const Slab& s, const Float8& x, const Float8& y, const Float8& z, Int8& is_inside) {
  const Float8 along_m = s.normal_x * x + s.normal_y * y + s.normal_z * z;
  is_inside = (s.lower_m < along_m) & (along_m < s.upper_m);
}

/// Calls use(x, y, z) with eight points at a time, the last of them filled up with NaNs.
template <typename Use>
void for_eights(const Points& points, Use use) noexcept {
  const float *x = points.x_m.data(), *y = points.y_m.data(), *z = points.z_m.data();
  const std::size_t whole = points.size() / kLanes * kLanes, rest = points.size() - whole;
  Float8 px, py, pz;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    load(x + i, px), load(y + i, py), load(z + i, pz);
    use(px, py, pz);
  }
  if (rest == 0) return;
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  load_part(x + whole, rest, kNone, px);
  load_part(y + whole, rest, kNone, py);
  load_part(z + whole, rest, kNone, pz);
  use(px, py, pz);
}

std::size_t total(const Int8& counts) noexcept {
  std::size_t result = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) result += static_cast<std::size_t>(counts[lane]);
  return result;
}

struct Moments {
  double count = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

/// Of coordinates about an origin.
template <typename Inside>
void add_moments(const Points& points, const Inside& inside, const Eigen::Vector3f& origin, Moments& to) {
  const float ox = origin.x(), oy = origin.y(), oz = origin.z();
  Int8 count{};
  Float8 x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for_eights(points, [&](const Float8& px, const Float8& py, const Float8& pz) {
    Int8 is_inside;
    find_inside(inside, px, py, pz, is_inside);
    const Float8 zero{};
    const Float8 dx = is_inside ? px - ox : zero;
    const Float8 dy = is_inside ? py - oy : zero;
    const Float8 dz = is_inside ? pz - oz : zero;
    count -= is_inside;
    x += dx, y += dy, z += dz;
    xx += dx * dx, xy += dx * dy, xz += dx * dz;
    yy += dy * dy, yz += dy * dz, zz += dz * dz;
  });
  to.count += static_cast<double>(total(count));
  to.first += Eigen::Vector3f(sum(x), sum(y), sum(z)).cast<double>();
  Eigen::Matrix3f second;
  second << sum(xx), sum(xy), sum(xz), sum(xy), sum(yy), sum(yz), sum(xz), sum(yz), sum(zz);
  to.second += second.cast<double>();
}

template <typename Inside>
PointStatistics statistics(const Points& points, const Inside& inside, const Eigen::Vector3f& origin) {
  // So many in float, then on in double: the sums of a whole sweep stay exact enough.
  constexpr std::size_t kChunk = 512 * kLanes;
  Moments moments;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunk) {
    const std::size_t size = std::min(kChunk, points.size() - begin);
    add_moments(points.from(begin, size), inside, origin, moments);
  }
  PointStatistics result;
  result.count = moments.count;
  if (moments.count == 0.0) return result;
  const Eigen::Vector3d offset = moments.first / moments.count;
  result.mean = origin.cast<double>() + offset;
  result.covariance = moments.second / moments.count - offset * offset.transpose();
  return result;
}

/// The least eigenvalue of a positive semi-definite matrix: Newton's steps from 0 on the characteristic
/// polynomial rise towards it and never pass it.
double least_eigenvalue(double trace, double minors, double determinant) noexcept {
  double w = 0.0;
  for (int i = 0; i < 32; ++i) {
    const double value = determinant - w * (minors - w * (trace - w));
    const double slope = minors - w * (2.0 * trace - 3.0 * w);
    if (!(slope > 0.0)) break;
    const double step = value / slope;
    w += step;
    if (!(std::abs(step) > 1e-15 * trace)) break;
  }
  return std::max(0.0, w);
}

struct Axes {
  Eigen::Vector3d normal, variance;
};

/// Of a plane with clear axes, by cross product; nothing where that would be inexact, e.g. for points on a
/// line.
std::optional<Axes> clear_axes(const Eigen::Matrix3d& C) noexcept {
  const double trace = C.trace();
  const double minors = C(0, 0) * C(1, 1) - C(0, 1) * C(0, 1) + C(0, 0) * C(2, 2) - C(0, 2) * C(0, 2) +
                        C(1, 1) * C(2, 2) - C(1, 2) * C(1, 2);
  const double w = least_eigenvalue(trace, minors, C.determinant());
  Eigen::Matrix3d rest = C;
  rest.diagonal().array() -= w;
  const Eigen::Vector3d a = rest.col(0).cross(rest.col(1)), b = rest.col(0).cross(rest.col(2)),
                        c = rest.col(1).cross(rest.col(2));
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
  const Eigen::Vector3d& longest = aa >= bb && aa >= cc ? a : (bb >= cc ? b : c);
  const double length = std::sqrt(std::max({aa, bb, cc}));
  // It is of the order of the product of the other two variances' distances from the least one.
  constexpr double kUnclear = 1e-7;
  if (!(length > kUnclear * trace * trace)) return std::nullopt;

  const double middle = 0.5 * (trace - w), product = minors - w * (trace - w);
  const double half_gap = std::sqrt(std::max(0.0, middle * middle - product));
  return Axes{longest / length, {w, middle - half_gap, middle + half_gap}};
}

Axes any_axes(const Eigen::Matrix3d& C) noexcept {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(C);
  return {solver.eigenvectors().col(0), solver.eigenvalues().cwiseMax(0.0)};
}

}  // namespace

Slab Slab::around(const Eigen::Vector3d& normal, double offset_m, double reach_m) {
  const Eigen::Vector3f n = normal.cast<float>();
  return {n.x(), n.y(), n.z(), static_cast<float>(offset_m - reach_m),
          static_cast<float>(offset_m + reach_m)};
}

PointStatistics statistics_inside(const Points& points,
                                  const HalfSpace& inside,
                                  const Eigen::Vector3f& origin) noexcept {
  return statistics(points, inside, origin);
}

PointStatistics statistics_inside(const Points& points,
                                  const Slab& inside,
                                  const Eigen::Vector3f& origin) noexcept {
  return statistics(points, inside, origin);
}

std::size_t count_inside(const Points& points, const Slab& slab) noexcept {
  Int8 count{};
  for_eights(points, [&](const Float8& x, const Float8& y, const Float8& z) {
    Int8 is_inside;
    find_inside(slab, x, y, z, is_inside);
    count -= is_inside;
  });
  return total(count);
}

HalfSpace PlaneFit::below(double thickness_m) const noexcept {
  const Eigen::Vector3f n = normal.cast<float>();
  return {n.x(), n.y(), n.z(), static_cast<float>(normal.dot(mean) + thickness_m)};
}

PlaneFit fit_plane(const PointStatistics& points) noexcept {
  PlaneFit fit;
  if (!(points.count >= 3.0) || !points.covariance.allFinite()) return fit;
  const std::optional<Axes> clear = clear_axes(points.covariance);
  const Axes axes = clear ? *clear : any_axes(points.covariance);
  if (!(axes.variance[2] > 0.0) || !axes.normal.allFinite()) return fit;

  fit.is_valid = true;
  fit.mean = points.mean;
  fit.variance = axes.variance;
  fit.normal = axes.normal.z() < 0.0 ? Eigen::Vector3d(-axes.normal) : axes.normal;
  return fit;
}

}  // namespace pago::ground
