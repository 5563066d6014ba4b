// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace pago {

/// How the sensor sits on the vehicle: T_base_sensor. `base_link` is on the ground below the sensor's origin;
/// roll, pitch and yaw turn the sensor against the vehicle (REP-103, R = Rz(yaw) Ry(pitch) Rx(roll)).
struct Mount {
  double height_m = 1.73;  ///< of the sensor's origin above the ground; [0.1, 10]
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;  ///< [-pi, pi]

  /// Rotates sensor coordinates so that z is the vehicle's up.
  Eigen::Matrix3d R_level_sensor() const {
    return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
  Eigen::Isometry3d T_base_sensor() const {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * R_level_sensor();
    T.translation().z() = height_m;
    return T;
  }
};

}  // namespace pago
