// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pago/core/aligned_array.hpp"
#include "pago/core/estimate.hpp"

namespace pago::odometry {

/// Features of one kind as the sensor saw them: coordinates in the sensor frame of each point's own firing
/// time. Structure of arrays with fixed capacity; `add` on a full cloud changes nothing and says so.
struct FeatureCloud {
  explicit FeatureCloud(std::size_t capacity)
      : x_m(capacity), y_m(capacity), z_m(capacity), before_s(capacity), ring(capacity) {}

  bool add(const Eigen::Vector3f& point, float before, std::uint8_t ring_index) noexcept {
    if (size == x_m.size()) return false;
    x_m[size] = point.x(), y_m[size] = point.y(), z_m[size] = point.z();
    before_s[size] = before;
    ring[size++] = ring_index;
    return true;
  }
  Eigen::Vector3f point(std::size_t i) const noexcept { return {x_m[i], y_m[i], z_m[i]}; }

  std::size_t size = 0;
  AlignedArray<float> x_m, y_m, z_m;
  AlignedArray<float>
      before_s;  ///< firing time before the sweep's reference instant, seconds; may be negative
  AlignedArray<std::uint8_t> ring;
};

/// Moves every point to the reference instant under constant velocity: T_reference_point = exp(-before_s *
/// twist). `twist` is per second, translation first, in the sensor frame. Series to third order in the angle:
/// within 1e-5 of exact for turns up to 0.1 rad in a sweep (60 degrees per second). Real-time safe.
void deskew(const FeatureCloud& raw, const Vector6d& twist, FeatureCloud& out) noexcept;

}  // namespace pago::odometry
