// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_five.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

namespace pago::mapping {

std::optional<FivePoints> nearest_five(const registration::KdTree& tree,
                                       const Eigen::Vector3d& query,
                                       double radius_m) {
  std::array<std::uint32_t, 5> indices{};
  std::array<float, 5> squared_m2{};
  if (tree.nearest(query.cast<float>(), indices, squared_m2) < indices.size()) return std::nullopt;
  if (!(squared_m2.back() < static_cast<float>(radius_m * radius_m))) return std::nullopt;
  FivePoints points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = tree.points()[indices[i]].cast<double>();
  return points;
}

std::optional<FiveLine> line_through(const FivePoints& points) noexcept {
  constexpr double kElongation = 3.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) centre += p / 5.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) covariance += (p - centre) * (p - centre).transpose() / 5.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  if (!(axes.eigenvalues()[2] > kElongation * axes.eigenvalues()[1])) return std::nullopt;
  return FiveLine{centre, axes.eigenvectors().col(2)};
}

std::optional<FivePlane> plane_through(const FivePoints& points) noexcept {
  constexpr double kFarthest_m = 0.2;
  Eigen::Matrix<double, 5, 3> A;
  for (int i = 0; i < 5; ++i) A.row(i) = points[static_cast<std::size_t>(i)].transpose();
  const Eigen::Vector3d n = A.colPivHouseholderQr().solve(Eigen::Matrix<double, 5, 1>::Constant(-1.0));
  const double size = n.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  const FivePlane plane{n / size, -1.0 / size};
  for (const Eigen::Vector3d& p : points)
    if (!(std::abs(plane.normal.dot(p) - plane.distance_m) <= kFarthest_m)) return std::nullopt;
  return plane;
}

}  // namespace pago::mapping
