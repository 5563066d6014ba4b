// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/symmetric6.hpp"

#include <cmath>
#include <limits>

#include "support/catch.hpp"

using namespace pago;

namespace {

/// Positive definite, eigenvalues over six orders of magnitude.
Matrix6d spread_matrix() {
  Matrix6d Q = Matrix6d::Identity();
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j) {
      const double angle = 0.3 + 0.7 * i - 0.2 * j;
      Matrix6d G = Matrix6d::Identity();
      G(i, i) = G(j, j) = std::cos(angle);
      G(i, j) = -std::sin(angle), G(j, i) = std::sin(angle);
      Q = Q * G;
    }
  Vector6d values;
  values << 1e-3, 0.1, 1.0, 10.0, 200.0, 1000.0;
  return Q * values.asDiagonal() * Q.transpose();
}

}  // namespace

TEST_CASE("eigenvalues ascend and rebuild the matrix", "[core][symmetric6]") {
  const Matrix6d A = spread_matrix();
  const Eigen6 eigen = eigen_of(A);
  for (int i = 1; i < 6; ++i) CHECK(eigen.values[i - 1] <= eigen.values[i]);
  CHECK(eigen.values[0] == Approx(1e-3));
  CHECK(eigen.values[5] == Approx(1000.0));
  CHECK((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - A).norm() < 1e-9);
  CHECK((eigen.vectors.transpose() * eigen.vectors - Matrix6d::Identity()).norm() < 1e-12);
}

TEST_CASE("a solution solves, an inverse inverts and is symmetric", "[core][symmetric6]") {
  const Matrix6d A = spread_matrix();
  Vector6d b;
  b << 1.0, -2.0, 3.0, 0.5, 0.0, -1.0;
  CHECK((A * solve_semidefinite(A, b) - b).norm() < 1e-9);
  const Matrix6d inverse = inverse_of(A);
  CHECK((A * inverse - Matrix6d::Identity()).norm() < 1e-8);
  CHECK(inverse == inverse.transpose());
}

TEST_CASE("what is not finite stays so, where callers look for it", "[core][symmetric6]") {
  Matrix6d A = spread_matrix();
  A(3, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(eigen_of(A).values.allFinite());
  CHECK_FALSE(inverse_of(A).allFinite());
  CHECK_FALSE(solve_semidefinite(A, Vector6d::Ones()).allFinite());
}
