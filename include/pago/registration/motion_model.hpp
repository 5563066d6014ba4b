// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "pago/core/estimate.hpp"

namespace pago::registration {

/// How well a motion over `period_s` is known from the one before it: information of the constant-velocity
/// prediction, right perturbation in the sensor frame, order x y z roll pitch yaw. A vehicle's acceleration
/// deviates by 2 m/s^2, its turn rate's change by 0.5 rad/s^2; the velocity itself is the less certain the
/// more motions in a row (`unconfirmed`, 0 for none) nothing has confirmed. Real-time safe.
Matrix6d predicted_information(double period_s, int unconfirmed) noexcept;

/// Whether a motion over `period_s` may follow one at `twist` (per second, of the interval before): six of
/// the deviations above at most. What is beyond has slipped, along scan lines as a rule. Real-time safe.
bool may_follow(const Eigen::Isometry3d& T_last_this,
                const Vector6d& twist,
                double period_s,
                int unconfirmed) noexcept;

/// A motion that was told twice, as `T_told` with information `told` and as `T_predicted` with `predicted`:
/// between the two, by their informations. Real-time safe.
Eigen::Isometry3d fused(const Eigen::Isometry3d& T_told,
                        const Matrix6d& told,
                        const Eigen::Isometry3d& T_predicted,
                        const Matrix6d& predicted) noexcept;

/// A motion is carried on for no longer than this: nothing says that the vehicle did not stop.
inline constexpr double kLongestPrediction_s = 3.0;

}  // namespace pago::registration
