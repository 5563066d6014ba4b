// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/se3.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "pago/core/mount.hpp"
#include "support/catch.hpp"

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using pago::Vector6d;

namespace {

constexpr double kPi = std::numbers::pi;

/// Every regime: exactly 0, series, both sides of the switches to closed forms, up to a half turn.
constexpr double kAngles_rad[] = {0.0, 1e-300, 1e-12, 1e-8,    1e-4, 0.0316,     0.0317,     0.0999,
                                  0.1, 0.1001, 0.5,   kPi / 2, 2.0,  kPi - 1e-3, kPi - 1e-8, kPi - 1e-12};

Vector3d random_axis(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Vector6d random_tangent(std::mt19937& random, double angle_rad) {
  Vector6d xi;
  xi << 10.0 * random_axis(random), angle_rad * random_axis(random);
  return xi;
}

Eigen::Matrix4d se3_matrix(const Vector6d& xi) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = pago::hat(xi.tail<3>());
  m.topRightCorner<3, 1>() = xi.head<3>();
  return m;
}

double distance(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("exp is the matrix exponential", "[core][se3]") {
  std::mt19937 random(1);
  for (const double angle_rad : kAngles_rad) {
    const Vector6d xi = random_tangent(random, angle_rad);
    const Eigen::Matrix4d oracle = se3_matrix(xi).exp();
    INFO("angle " << angle_rad);
    CHECK((pago::exp_se3(xi).matrix() - oracle).cwiseAbs().maxCoeff() < 2e-14);
    CHECK((pago::exp_so3(xi.tail<3>()) - oracle.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff() < 3e-15);
  }
}

TEST_CASE("log undoes exp at every angle below pi", "[core][se3]") {
  std::mt19937 random(2);
  for (const double angle_rad : kAngles_rad) {
    for (int i = 0; i < 20; ++i) {
      const Vector6d xi = random_tangent(random, angle_rad);
      INFO("angle " << angle_rad);
      CHECK((pago::log_se3(pago::exp_se3(xi)) - xi).cwiseAbs().maxCoeff() < 1e-13);
    }
  }
}

TEST_CASE("exp undoes log for every rotation, half turns included", "[core][se3]") {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    Isometry3d T = Isometry3d::Identity();
    const double angle_rad = i % 3 == 0 ? kPi : 2.0 * kPi * (i / 300.0);
    const Vector3d axis = i < 30 ? Vector3d(Vector3d::Unit(i % 3)) : random_axis(random);
    T.linear() = Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
    T.translation() = 50.0 * random_axis(random);
    CHECK(distance(pago::exp_se3(pago::log_se3(T)), T) < 2e-13);
    CHECK(pago::log_so3(T.linear()).norm() <= kPi * (1.0 + 1e-15));
  }
}

TEST_CASE("tiny rotations keep their relative precision", "[core][se3]") {
  for (const double angle_rad : {1e-3, 1e-7, 1e-11, 1e-15}) {
    const Vector3d phi = angle_rad * Vector3d(0.6, 0.0, 0.8);
    const Vector3d back = pago::log_so3(pago::exp_so3(phi));
    CHECK((back - phi).norm() < 1e-15 * angle_rad + 1e-20);
  }
}

TEST_CASE("the left Jacobian is exp's numeric derivative, and its inverse inverts it", "[core][se3]") {
  std::mt19937 random(4);
  constexpr double kStep = 1e-6;
  for (const double angle_rad : kAngles_rad) {
    const Vector3d phi = angle_rad * random_axis(random);
    Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const Matrix3d plus = pago::exp_so3(phi + kStep * Vector3d::Unit(k));
      const Matrix3d minus = pago::exp_so3(phi - kStep * Vector3d::Unit(k));
      numeric.col(k) = pago::log_so3(plus * minus.transpose()) / (2.0 * kStep);
    }
    const Matrix3d J = pago::left_jacobian_so3(phi);
    INFO("angle " << angle_rad);
    CHECK((J - numeric).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((J * pago::inverse_left_jacobian_so3(phi) - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("the adjoint carries a perturbation to the other side", "[core][se3]") {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    const Isometry3d T = pago::exp_se3(random_tangent(random, 0.06 * i));
    const Vector6d d = 0.1 * random_tangent(random, 0.5);
    CHECK(distance(pago::perturb(T, d), pago::exp_se3(pago::adjoint(T) * d) * T) < 1e-12);
  }
}

TEST_CASE("difference is what perturb needs to get there", "[core][se3]") {
  std::mt19937 random(6);
  for (int i = 0; i < 50; ++i) {
    const Isometry3d a = pago::exp_se3(random_tangent(random, 0.06 * i));
    const Isometry3d b = pago::exp_se3(random_tangent(random, 3.0 - 0.05 * i));
    CHECK(distance(pago::perturb(a, pago::difference(a, b)), b) < 1e-12);
  }
}

TEST_CASE("interpolation meets both ends and moves evenly", "[core][se3]") {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const Isometry3d a = pago::exp_se3(random_tangent(random, 1.0));
    const Isometry3d b = a * pago::exp_se3(random_tangent(random, 0.06 * i));
    CHECK(distance(pago::interpolate(a, b, 0.0), a) < 1e-13);
    CHECK(distance(pago::interpolate(a, b, 1.0), b) < 1e-12);
    CHECK(distance(pago::interpolate_straight(a, b, 0.0), a) < 1e-13);
    CHECK(distance(pago::interpolate_straight(a, b, 1.0), b) < 1e-12);

    const Isometry3d third = pago::interpolate(a, b, 1.0 / 3.0),
                     two_thirds = pago::interpolate(a, b, 2.0 / 3.0);
    CHECK(distance(a.inverse() * third, third.inverse() * two_thirds) < 1e-12);
    CHECK(distance(a.inverse() * third, two_thirds.inverse() * b) < 1e-12);

    const Isometry3d straight = pago::interpolate_straight(a, b, 0.25);
    CHECK((straight.translation() - 0.75 * a.translation() - 0.25 * b.translation()).norm() < 1e-13);
    const Eigen::Quaterniond slerp =
        Eigen::Quaterniond(a.linear()).slerp(0.25, Eigen::Quaterniond(b.linear()));
    CHECK((straight.linear() - slerp.toRotationMatrix()).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("a quarter circle is interpolated along the circle", "[core][se3]") {
  // Driving with radius 10 m, turning left: after 45 degrees x = r sin, y = r (1 - cos).
  Isometry3d quarter = Isometry3d::Identity();
  quarter.linear() = Eigen::AngleAxisd(kPi / 2.0, Vector3d::UnitZ()).toRotationMatrix();
  quarter.translation() = Vector3d(10.0, 10.0, 0.0);
  const Isometry3d half = pago::interpolate(Isometry3d::Identity(), quarter, 0.5);
  const double root = std::sqrt(0.5);
  CHECK((half.translation() - Vector3d(10.0 * root, 10.0 * (1.0 - root), 0.0)).norm() < 1e-13);
  CHECK(pago::roll_pitch_yaw(half.linear()).yaw_rad == Approx(kPi / 4.0).epsilon(1e-14));
}

TEST_CASE("roll, pitch and yaw come back from the rotation that they make", "[core][se3]") {
  for (double roll = -3.1; roll < 3.2; roll += 0.31) {
    for (double pitch = -1.5; pitch < 1.6; pitch += 0.25) {
      for (double yaw = -3.1; yaw < 3.2; yaw += 0.31) {
        const auto angles = pago::roll_pitch_yaw(pago::rotation({roll, pitch, yaw}));
        REQUIRE(angles.roll_rad == Approx(roll).margin(1e-13));
        REQUIRE(angles.pitch_rad == Approx(pitch).margin(1e-14));
        REQUIRE(angles.yaw_rad == Approx(yaw).margin(1e-13));
      }
    }
  }
}

TEST_CASE("looking straight up or down still gives angles that make the same rotation", "[core][se3]") {
  for (const double pitch : {kPi / 2.0, -kPi / 2.0, kPi / 2.0 - 1e-9, -kPi / 2.0 + 1e-12}) {
    for (double roll = -3.0; roll < 3.1; roll += 0.5) {
      const Matrix3d R = pago::rotation({roll, pitch, 0.7});
      const Matrix3d again = pago::rotation(pago::roll_pitch_yaw(R));
      REQUIRE((R - again).cwiseAbs().maxCoeff() < 1e-14);
    }
  }
}

TEST_CASE("the mount's angles follow the same convention", "[core][se3]") {
  const pago::Mount mount{.height_m = 2.0, .roll_rad = 0.1, .pitch_rad = -0.2, .yaw_rad = 0.3};
  const Isometry3d T = mount.T_base_sensor();
  CHECK((T.linear() - pago::rotation({0.1, -0.2, 0.3})).cwiseAbs().maxCoeff() < 1e-15);
  CHECK((mount.R_level_sensor() - pago::rotation({0.1, -0.2, 0.0})).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(T.translation() == Vector3d(0.0, 0.0, 2.0));
}

TEST_CASE("a long product stays a rotation when orthonormalised", "[core][se3]") {
  std::mt19937 random(8);
  Isometry3d T = Isometry3d::Identity();
  for (int i = 0; i < 20000; ++i) {
    T = pago::orthonormalized(T * pago::exp_se3(0.1 * random_tangent(random, 0.2)));
  }
  CHECK((T.linear().transpose() * T.linear() - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(T.linear().determinant() == Approx(1.0).epsilon(1e-15));

  Isometry3d bent = T;
  bent.linear() += 1e-6 * Matrix3d::Random();
  CHECK(distance(pago::orthonormalized(bent), T) < 3e-6);
  CHECK(bent.translation() == T.translation());
}

TEST_CASE("not a number goes through and does not become a pose", "[core][se3]") {
  Vector6d xi = Vector6d::Zero();
  xi[4] = std::numeric_limits<double>::quiet_NaN();
  CHECK(!pago::exp_se3(xi).matrix().allFinite());
  Isometry3d T = Isometry3d::Identity();
  T.linear()(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(!pago::log_se3(T).allFinite());
}
