// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "pago/registration/rows.hpp"

/// What LOAM's front end and its mapping have in common (their code). [any thread] real-time safe.
namespace pago::registration {

/// The row of a point `source` (sensor frame) that is `distance_m` off what it was matched with, along
/// `normal` (target frame). LOAM multiplies row and residual by `s`, so that s squared is the weight; a match
/// with a tenth or less is none.
inline std::optional<Row> loam_row(const Eigen::Isometry3d& T_target_source,
                                   const Eigen::Vector3d& source,
                                   const Eigen::Vector3d& normal,
                                   double distance_m,
                                   double s) noexcept {
  constexpr double kLeast = 0.1;
  if (!(s > kLeast)) return std::nullopt;
  Row row = plane_row(source.cast<float>(), (T_target_source.linear().transpose() * normal).cast<float>(),
                      static_cast<float>(distance_m), 1.0F);
  row.kernel_weight = static_cast<float>(s * s);
  return row;
}

/// Takes out of a step the directions whose eigenvalue is below `least`: LOAM's matP.
template <int N>
Eigen::Matrix<double, N, N> strong_directions(const Eigen::Matrix<double, N, 1>& eigenvalues,
                                              const Eigen::Matrix<double, N, N>& eigenvectors,
                                              double least) noexcept {
  Eigen::Matrix<double, N, N> strong = Eigen::Matrix<double, N, N>::Zero();
  for (int i = 0; i < N; ++i)
    if (eigenvalues[i] >= least) strong += eigenvectors.col(i) * eigenvectors.col(i).transpose();
  return strong;
}

}  // namespace pago::registration
