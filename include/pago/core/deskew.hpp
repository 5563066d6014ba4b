// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/estimate.hpp"
#include "pago/core/se3.hpp"

namespace pago {

/// How a sensor moves about an instant, the reference: T_reference_sensor(t) = exp(t twist + t^2 / 2
/// acceleration), translation first, in the sensor frame. Good for half a sweep to either side.
struct MotionInSweep {
  Vector6d twist = Vector6d::Zero();         ///< per second
  Vector6d acceleration = Vector6d::Zero();  ///< per second squared

  /// The pose `after_s` after the reference instant, seen from there.
  Eigen::Isometry3d pose_at(double after_s) const noexcept {
    return exp_se3(after_s * (twist + 0.5 * after_s * acceleration));
  }
  Vector6d twist_at(double after_s) const noexcept { return twist + after_s * acceleration; }
};

/// Moves points to the reference instant: T_reference_point = pose_at(-before_s). Series to third order in
/// the angle: within 1e-5 of exact for turns up to 0.1 rad in half a sweep (115 degrees per second).
/// Real-time safe.
class Deskew {
 public:
  explicit Deskew(const MotionInSweep& motion)
      : v_(motion.twist.head<3>().cast<float>()),
        w_(motion.twist.tail<3>().cast<float>()),
        half_dv_(0.5F * motion.acceleration.head<3>().cast<float>()),
        half_dw_(0.5F * motion.acceleration.tail<3>().cast<float>()) {}
  /// At constant velocity.
  explicit Deskew(const Vector6d& twist) : Deskew(MotionInSweep{twist}) {}

  // exp(a) p = p + a x p + a x (a x p) / 2 + ..., its translation V(a) u = u + a x u / 2 + a x (a x u) / 6 +
  // ...
  Eigen::Vector3f operator()(const Eigen::Vector3f& p, float before_s) const noexcept {
    const float s = -before_s;
    const Eigen::Vector3f v = v_ + s * half_dv_, w = w_ + s * half_dw_;
    const Eigen::Vector3f first = w.cross(p) + v, second = w.cross(first), third = w.cross(second);
    return p + s * (first + s * (0.5F * second + s * (1.0F / 6.0F) * third));
  }

 private:
  Eigen::Vector3f v_, w_, half_dv_, half_dw_;
};

}  // namespace pago
