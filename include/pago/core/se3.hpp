// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pago/core/estimate.hpp"

/// Rigid motions and their tangents. A tangent vector is always (x y z roll pitch yaw): translation part rho
/// in metres first, rotation part phi = axis * angle in radians after it, as in Estimate::covariance.
/// Formulas: J. Sola et al., "A micro Lie theory for state estimation in robotics", 2018, appendices B and D.
/// [any thread] All functions are pure, real-time safe, and accurate to about 1e-14 from angle 0 up to and
/// including pi; not-finite input gives not-finite output.
namespace pago {

/// The matrix with hat(a) b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& a) noexcept;

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& phi_rad) noexcept;
/// Of the two logarithms of a half turn either may come; otherwise |log| < pi.
Eigen::Vector3d log_so3(const Eigen::Matrix3d& R) noexcept;

/// exp(phi + d) = exp(J(phi) d) exp(phi) to first order; the right Jacobian is J(-phi).
Eigen::Matrix3d left_jacobian_so3(const Eigen::Vector3d& phi_rad) noexcept;
/// Inverse of the above; it exists below a full turn.
Eigen::Matrix3d inverse_left_jacobian_so3(const Eigen::Vector3d& phi_rad) noexcept;

Eigen::Isometry3d exp_se3(const Vector6d& xi) noexcept;
Vector6d log_se3(const Eigen::Isometry3d& T) noexcept;

/// T exp(d) = exp(adjoint(T) d) T: carries a tangent, and by A S A^T its covariance, from T's source frame to
/// its target frame.
Matrix6d adjoint(const Eigen::Isometry3d& T) noexcept;

/// Right perturbation: T exp(d), a small motion d seen from the moving frame.
Eigen::Isometry3d perturb(const Eigen::Isometry3d& T, const Vector6d& d) noexcept;
/// The d with perturb(T_from, d) = T_to.
Vector6d difference(const Eigen::Isometry3d& T_from, const Eigen::Isometry3d& T_to) noexcept;

/// Between two poses of one frame with constant velocity and turn rate, as that frame feels them (a screw
/// motion); s = 0 gives `T_0`, 1 gives `T_1`, beyond extrapolates.
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& T_0, const Eigen::Isometry3d& T_1, double s) noexcept;
/// The same with the translation on a straight line in the outer frame (slerp and lerp).
Eigen::Isometry3d interpolate_straight(const Eigen::Isometry3d& T_0,
                                       const Eigen::Isometry3d& T_1,
                                       double s) noexcept;

/// REP-103: R = Rz(yaw) Ry(pitch) Rx(roll).
struct RollPitchYaw {
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
};
/// roll and yaw in [-pi, pi], pitch in [-pi/2, pi/2]. At pitch +-pi/2 only yaw -+ roll is determined; the
/// answer is still one that gives R back.
RollPitchYaw roll_pitch_yaw(const Eigen::Matrix3d& R) noexcept;
Eigen::Matrix3d rotation(const RollPitchYaw& angles) noexcept;

/// Takes out what rounding has added to a long product: the rotation becomes a rotation again.
Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T) noexcept;

}  // namespace pago
