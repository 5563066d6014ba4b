// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "pago/config/vehicle.hpp"
#include "pago/core/mount.hpp"
#include "pago/hdl64/packet_decoder.hpp"

namespace pago {

/// Knows the vehicle's own body. Default-constructed it has none. [any thread] real-time safe.
class SelfFilter {
 public:
  SelfFilter() = default;
  SelfFilter(const VehicleConfig& vehicle, const Mount& mount);

  bool has_box() const noexcept { return reach_sq_m2_ > 0.0F; }

  /// Whether a point in the sensor's frame is on the vehicle's body.
  bool is_own(float x_m, float y_m, float z_m) const noexcept {
    if (x_m * x_m + y_m * y_m + z_m * z_m >= reach_sq_m2_) return false;
    const Eigen::Vector3f p = R_base_sensor_ * Eigen::Vector3f(x_m, y_m, z_m);
    return (p.array() > min_m_.array()).all() && (p.array() < max_m_.array()).all();
  }

  /// Takes the returns on the vehicle's body out of a firing; returns how many there were.
  int remove_own(hdl64::FiringReturns& returns) const noexcept;

 private:
  Eigen::Matrix3f R_base_sensor_ = Eigen::Matrix3f::Identity();
  // The box about the sensor's origin, in base_link's directions; and its farthest corner.
  Eigen::Vector3f min_m_ = Eigen::Vector3f::Zero(), max_m_ = Eigen::Vector3f::Zero();
  float reach_sq_m2_ = 0.0F;
};

}  // namespace pago
