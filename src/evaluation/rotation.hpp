// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/se3.hpp"

namespace pago::evaluation {

inline constexpr double kDegPerRad = 57.295779513082320876798154814105;

inline Eigen::Vector3d roll_pitch_yaw_rad(const Eigen::Matrix3d& R) {
  const RollPitchYaw angles = roll_pitch_yaw(R);
  return {angles.roll_rad, angles.pitch_rad, angles.yaw_rad};
}

}  // namespace pago::evaluation
