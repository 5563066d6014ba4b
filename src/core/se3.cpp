// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/se3.hpp"

#include <cmath>

namespace pago {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// sin(theta) / theta and (1 - cos(theta)) / theta^2; neither cancels near 0.
struct Rodrigues {
  double a, b;
};
Rodrigues rodrigues(double theta) noexcept {
  if (theta < 1e-12) return {1.0, 0.5};
  const double half = std::sin(0.5 * theta) / theta;
  return {std::sin(theta) / theta, 2.0 * half * half};
}

/// (theta - sin(theta)) / theta^3. Below 0.1 rad by its series, where the difference would cancel; the first
/// term left out is theta^8 / 11! = 2.5e-16.
double third_coefficient(double theta) noexcept {
  const double t2 = theta * theta;
  if (t2 < 1e-2) return 1.0 / 6.0 - t2 / 120.0 * (1.0 - t2 / 42.0 * (1.0 - t2 / 72.0));
  return (theta - std::sin(theta)) / (t2 * theta);
}

/// (1 - (theta / 2) cot(theta / 2)) / theta^2, by its series below 0.03 rad (first term left out: 6e-16).
double inverse_coefficient(double theta) noexcept {
  const double t2 = theta * theta;
  if (t2 < 1e-3) return 1.0 / 12.0 + t2 / 720.0 * (1.0 + t2 / 42.0);
  return (1.0 - 0.5 * theta / std::tan(0.5 * theta)) / t2;
}

/// The vector part decides; no trigonometric inverse is evaluated where it is flat, so small angles and half
/// turns keep all digits.
Vector3d log_of(Eigen::Quaterniond q) noexcept {
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine == 0.0) return Vector3d::Zero();
  return q.vec() * (2.0 * std::atan2(sine, q.w()) / sine);
}

}  // namespace

Matrix3d hat(const Vector3d& a) noexcept {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Matrix3d exp_so3(const Vector3d& phi) noexcept {
  const Rodrigues c = rodrigues(phi.norm());
  const Matrix3d w = hat(phi);
  return Matrix3d::Identity() + c.a * w + c.b * w * w;
}

Vector3d log_so3(const Matrix3d& R) noexcept {
  return log_of(Eigen::Quaterniond(R).normalized());
}

Matrix3d left_jacobian_so3(const Vector3d& phi) noexcept {
  const double theta = phi.norm();
  const Matrix3d w = hat(phi);
  return Matrix3d::Identity() + rodrigues(theta).b * w + third_coefficient(theta) * w * w;
}

Matrix3d inverse_left_jacobian_so3(const Vector3d& phi) noexcept {
  const Matrix3d w = hat(phi);
  return Matrix3d::Identity() - 0.5 * w + inverse_coefficient(phi.norm()) * w * w;
}

Isometry3d exp_se3(const Vector6d& xi) noexcept {
  Isometry3d T = Isometry3d::Identity();
  T.linear() = exp_so3(xi.tail<3>());
  T.translation() = left_jacobian_so3(xi.tail<3>()) * xi.head<3>();
  return T;
}

Vector6d log_se3(const Isometry3d& T) noexcept {
  Vector6d xi;
  xi.tail<3>() = log_so3(T.linear());
  xi.head<3>() = inverse_left_jacobian_so3(xi.tail<3>()) * T.translation();
  return xi;
}

Matrix6d adjoint(const Isometry3d& T) noexcept {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = hat(T.translation()) * T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  return A;
}

Isometry3d perturb(const Isometry3d& T, const Vector6d& d) noexcept {
  return T * exp_se3(d);
}

Vector6d difference(const Isometry3d& T_from, const Isometry3d& T_to) noexcept {
  return log_se3(T_from.inverse() * T_to);
}

Isometry3d interpolate(const Isometry3d& T_0, const Isometry3d& T_1, double s) noexcept {
  return perturb(T_0, s * difference(T_0, T_1));
}

Isometry3d interpolate_straight(const Isometry3d& T_0, const Isometry3d& T_1, double s) noexcept {
  Isometry3d T = Isometry3d::Identity();
  T.linear() = T_0.linear() * exp_so3(s * log_so3(T_0.linear().transpose() * T_1.linear()));
  T.translation() = T_0.translation() + s * (T_1.translation() - T_0.translation());
  return T;
}

/// Roll and pitch are read after turning yaw back, so they stay consistent with it even where yaw itself is
/// noise (pitch +-pi/2).
RollPitchYaw roll_pitch_yaw(const Matrix3d& R) noexcept {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {.roll_rad = std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)),
          .pitch_rad = std::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)),
          .yaw_rad = yaw};
}

Matrix3d rotation(const RollPitchYaw& angles) noexcept {
  return (Eigen::AngleAxisd(angles.yaw_rad, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.pitch_rad, Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.roll_rad, Vector3d::UnitX()))
      .toRotationMatrix();
}

Isometry3d orthonormalized(const Isometry3d& T) noexcept {
  Isometry3d out = T;
  out.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return out;
}

}  // namespace pago
