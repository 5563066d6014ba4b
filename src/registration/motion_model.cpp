// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/motion_model.hpp"

#include <algorithm>

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"

namespace pago::registration {

Matrix6d predicted_information(double period_s, int unconfirmed) noexcept {
  constexpr double kAcceleration_m_s2 = 2.0, kTurnAcceleration_rad_s2 = 0.5;
  constexpr double kShortest_s = 0.01;
  const double period_sq = std::max(period_s, kShortest_s) * std::max(period_s, kShortest_s);
  const double variance_factor = period_sq * period_sq * (1 + unconfirmed);
  Vector6d diagonal;
  diagonal.head<3>().setConstant(1.0 / (kAcceleration_m_s2 * kAcceleration_m_s2 * variance_factor));
  diagonal.tail<3>().setConstant(1.0 /
                                 (kTurnAcceleration_rad_s2 * kTurnAcceleration_rad_s2 * variance_factor));
  return diagonal.asDiagonal();
}

bool may_follow(const Eigen::Isometry3d& T_last_this,
                const Vector6d& twist,
                double period_s,
                int unconfirmed) noexcept {
  constexpr double kDeviations = 6.0;
  const Vector6d off = difference(exp_se3(twist * period_s), T_last_this);
  return off.dot(predicted_information(period_s, unconfirmed) * off) <= kDeviations * kDeviations;
}

Eigen::Isometry3d fused(const Eigen::Isometry3d& T_told,
                        const Matrix6d& told,
                        const Eigen::Isometry3d& T_predicted,
                        const Matrix6d& predicted) noexcept {
  const Vector6d off = difference(T_told, T_predicted);
  return perturb(T_told, inverse_of(told + predicted) * predicted * off);
}

}  // namespace pago::registration
