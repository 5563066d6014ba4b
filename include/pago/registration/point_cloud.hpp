// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pago/core/aligned_array.hpp"
#include "pago/core/estimate.hpp"

namespace pago::registration {

/// Points as the sensor saw them: coordinates in the sensor frame of each point's own firing time. Structure
/// of arrays with fixed capacity; `add` on a full cloud changes nothing and says so.
struct PointCloud {
  explicit PointCloud(std::size_t capacity)
      : x_m(capacity), y_m(capacity), z_m(capacity), before_s(capacity), tag(capacity) {}

  bool add(const Eigen::Vector3f& point, float before, std::uint8_t tag_value) noexcept {
    if (size == x_m.size()) return false;
    x_m[size] = point.x(), y_m[size] = point.y(), z_m[size] = point.z();
    before_s[size] = before;
    tag[size++] = tag_value;
    return true;
  }
  Eigen::Vector3f point(std::size_t i) const noexcept { return {x_m[i], y_m[i], z_m[i]}; }

  std::size_t size = 0;
  AlignedArray<float> x_m, y_m, z_m;
  AlignedArray<float> before_s;    ///< firing time before the reference instant, seconds; may be negative
  AlignedArray<std::uint8_t> tag;  ///< kGround or kNonGround, or the ring: whatever the matching needs
};

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

/// The whole cloud; `out` has before_s 0 throughout. Capacity of `out` at least raw.size.
void deskew(const PointCloud& raw, const Vector6d& twist, PointCloud& out) noexcept;

}  // namespace pago::registration
