// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/estimate.hpp"

namespace pago {

/// Moves a point to the reference instant under constant velocity: T_reference_point = exp(-before_s *
/// twist). `twist` is per second, translation first, in the sensor frame. Series to third order in the angle:
/// within 1e-5 of exact for turns up to 0.1 rad in half a sweep (115 degrees per second). Real-time safe.
class Deskew {
 public:
  explicit Deskew(const Vector6d& twist)
      : v_(twist.head<3>().cast<float>()),
        w_(twist.tail<3>().cast<float>()),
        wv_(w_.cross(v_)),
        wwv_(w_.cross(wv_)) {}

  // exp(a) p = p + a x p + a x (a x p) / 2 + ..., its translation V(a) u = u + a x u / 2 + a x (a x u) / 6 +
  // ...
  Eigen::Vector3f operator()(const Eigen::Vector3f& p, float before_s) const noexcept {
    const float s = -before_s;
    const Eigen::Vector3f wp = w_.cross(p), wwp = w_.cross(wp), wwwp = w_.cross(wwp);
    return p + s * (wp + v_ + s * (0.5F * (wwp + wv_) + s * (1.0F / 6.0F) * (wwwp + wwv_)));
  }

 private:
  Eigen::Vector3f v_, w_, wv_, wwv_;
};

}  // namespace pago
