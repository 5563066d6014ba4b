// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <span>

#include "pago/core/aligned_array.hpp"
#include "pago/core/estimate.hpp"

namespace pago::registration {

/// One residual, linearised in a right perturbation of the sensor's pose, order x y z roll pitch yaw.
struct Row {
  Eigen::Matrix<float, 6, 1> J;
  float residual_m = 0.0F;
  float variance_m2 = 1.0F;    ///< of the residual, were it an inlier
  float kernel_weight = 1.0F;  ///< in [0, 1]: how much of an inlier it is
  std::uint8_t block = 0;      ///< where it is, in blocks of 4 m that repeat after 64 m
};
using Rows = FixedVector<Row>;

/// The block of a point in the sensor's frame.
inline std::uint8_t block_of(const Eigen::Vector3f& p) noexcept {
  constexpr float kPerBlock_m = 0.25F;
  const auto index = [](float m) {
    return static_cast<unsigned>(static_cast<int>(std::floor(kPerBlock_m * m))) % 16U;
  };
  return static_cast<std::uint8_t>(index(p.x()) * 16U + index(p.y()));
}

/// The row of a point `p` (sensor frame) that should lie on a plane with unit normal `n` (sensor frame):
/// d/dd n . T exp(d) p = (n, p x n).
inline Row plane_row(const Eigen::Vector3f& p,
                     const Eigen::Vector3f& n,
                     float residual_m,
                     float variance_m2) noexcept {
  Row row;
  row.J << n, p.cross(n);
  row.residual_m = residual_m, row.variance_m2 = variance_m2;
  row.block = block_of(p);
  return row;
}

struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();  ///< information: sum of w J J^T, w = kernel weight / variance
  Vector6d b = Vector6d::Zero();  ///< sum of w r J
  double weight = 0.0, weighted_sq_m2 = 0.0;

  void add(std::span<const Row> rows) noexcept;
  double rms_m() const noexcept;  ///< weighted; 0 without rows
};

/// Directions of motion that the rows say too little about.
struct WeakDirections {
  int count = 0;
  /// Added to H it forbids steps along them. Zero when there are none.
  Matrix6d penalty = Matrix6d::Zero();
  /// Takes them out: strong^T I strong is an information without what it says about them.
  Matrix6d strong = Matrix6d::Identity();
  /// Bit i: the i-th of x y z roll pitch yaw lies mostly in them.
  std::uint8_t axes = 0;

  Matrix6d without(const Matrix6d& information) const noexcept {
    return strong.transpose() * information * strong;
  }
};

/// Looks at each principal direction of the information: how many inliers' worth of rows speak for it
/// clearly? A row counts with the square of its cosine to the direction, and not at all when that is below a
/// quarter: noise in the normals gives every direction some information, as the walls of a smooth tunnel do
/// along it. And what stands within 4 m counts as one inlier at most: a lone car ahead that drives as fast as
/// this vehicle would make it stand. (After X-ICP: Tuna et al. 2022; rotations are made comparable by a lever
/// arm of 10 m.)
WeakDirections find_weak_directions(const Matrix6d& information,
                                    std::span<const Row> rows,
                                    double min_contribution) noexcept;

/// Makes rotations comparable with translations: what a turn moves at this distance.
inline constexpr double kLeverArm_m = 10.0;

}  // namespace pago::registration
