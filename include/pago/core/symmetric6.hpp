// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/estimate.hpp"

/// The three things that registration does with symmetric 6 x 6 matrices. They stand here once because
/// Eigen's templates for them take 15 s to compile. [any thread] Pure, real-time safe.
namespace pago {

struct Eigen6 {
  Vector6d values = Vector6d::Zero();       ///< ascending
  Matrix6d vectors = Matrix6d::Identity();  ///< unit eigenvectors, one per column
};

/// Of a symmetric matrix; only its lower half is read. Not finite where A is not.
Eigen6 eigen_of(const Matrix6d& A) noexcept;

/// x with A x = b, for positive semi-definite A (LDLT, pivoted). Where A is singular some x, or not finite.
Vector6d solve_semidefinite(const Matrix6d& A, const Vector6d& b) noexcept;

/// Of a positive definite matrix; symmetric to the last bit. Not finite where A is singular.
Matrix6d inverse_of(const Matrix6d& A) noexcept;

}  // namespace pago
