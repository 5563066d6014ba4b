// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "pago/config/mapping.hpp"
#include "pago/core/units.hpp"

namespace pago::mapping {

/// Chooses keyframes: sweeps far enough from the last one, or turned enough. [estimate thread] real-time
/// safe, deterministic.
class Keyframes {
 public:
  explicit Keyframes(const KeyframesConfig& config) noexcept : config_(config) {}

  /// Whether the sweep at this pose becomes one.
  bool take(const Eigen::Isometry3d& T_odom_sensor) noexcept {
    const Eigen::Isometry3d T_last_this = T_odom_last_.inverse() * T_odom_sensor;
    const bool is_far = T_last_this.translation().norm() >= config_.distance_m ||
                        Eigen::AngleAxisd(T_last_this.rotation()).angle() >= config_.angle_deg * kDegree;
    if (has_last_ && !is_far) return false;
    T_odom_last_ = T_odom_sensor;
    return has_last_ = true;
  }

  void reset() noexcept { has_last_ = false; }

 private:
  KeyframesConfig config_;
  bool has_last_ = false;
  Eigen::Isometry3d T_odom_last_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::mapping
