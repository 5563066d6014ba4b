// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "pago/core/estimate.hpp"

namespace pago::mapping {

/// Knows when the sensor stands still, and then averages: what is left of each sweep's noise becomes smaller
/// with every sweep, and the pose does not creep. [estimate thread] real-time safe, deterministic.
class Standstill {
 public:
  /// A registered sweep: its pose, the motion to it from the last one and that motion's information (right
  /// perturbation, x y z roll pitch yaw). Returns the pose to believe.
  Eigen::Isometry3d update(const Eigen::Isometry3d& T_map_measured,
                           const Eigen::Isometry3d& T_last_this,
                           const Matrix6d& information) noexcept;

  /// Nothing was measured, or all is new.
  void reset() noexcept { num_still_ = 0; }

  /// The last motion was none, as far as can be told.
  bool is_still() const noexcept { return num_still_ > 0; }
  /// And so were those before.
  bool is_standing() const noexcept { return num_still_ >= kLeastStill; }

 private:
  /// So many sweeps in a row that do not move tell a stop from a slow start.
  static constexpr int kLeastStill = 3;

  int num_still_ = 0;
  Eigen::Isometry3d T_map_mean_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::mapping
