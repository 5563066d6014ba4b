// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace pago::evaluation {

/// The plane through points by least squares.
struct Plane {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  ///< along normal, middle and longest axis
  double distance_m(const Eigen::Vector3d& p) const { return std::abs(normal.dot(p - mean)); }
};

/// Points of one cell, summed up.
struct CellSums {
  double n = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  // sums are about it: no digits are lost far away
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    if (n == 0.0) first = p;
    const Eigen::Vector3d q = p - first;
    n += 1.0;
    sum += q;
    squares += q * q.transpose();
  }
  Plane plane() const {
    const Eigen::Vector3d mean = sum / n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares / n - mean * mean.transpose());
    return {first + mean, axes.eigenvectors().col(0), axes.eigenvalues().cwiseMax(0.0)};
  }
};

/// Which cell of this size a point is in.
inline std::uint64_t cell_key(const Eigen::Vector3d& p, double cell_m) {
  const Eigen::Vector3i c = (p / cell_m).array().floor().matrix().cast<int>();
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(c.x()) << 42U | part(c.y()) << 21U | part(c.z());
}

}  // namespace pago::evaluation
