// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pago/core/aligned_array.hpp"
#include "pago/core/deskew.hpp"

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

/// The whole cloud; `out` has before_s 0 throughout. Capacity of `out` at least raw.size.
void deskew(const PointCloud& raw, const Vector6d& twist, PointCloud& out) noexcept;

}  // namespace pago::registration
