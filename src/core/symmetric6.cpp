// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/symmetric6.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pago {

Eigen6 eigen_of(const Matrix6d& A) noexcept {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector6d solve_semidefinite(const Matrix6d& A, const Vector6d& b) noexcept {
  return A.ldlt().solve(b);
}

Matrix6d inverse_of(const Matrix6d& A) noexcept {
  const Matrix6d inverse = A.ldlt().solve(Matrix6d::Identity());
  return 0.5 * (inverse + inverse.transpose());
}

}  // namespace pago
