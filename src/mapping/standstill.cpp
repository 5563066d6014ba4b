// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/standstill.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"

namespace pago::mapping {

namespace {

/// Whether a motion is none, by what it can be told from: three deviations, at least a centimetre and 1 mrad.
/// What is beyond 5 cm or 5 mrad is motion even where little can be told.
bool is_none(const Vector6d& motion, const Matrix6d& information) noexcept {
  constexpr double kLeast_m = 0.01, kMost_m = 0.05, kLeast_rad = 0.001, kMost_rad = 0.005;
  const Matrix6d covariance = inverse_of(information);
  if (!covariance.allFinite()) return false;
  const double sigma_m = std::sqrt(std::max(0.0, covariance.topLeftCorner<3, 3>().trace()));
  const double sigma_rad = std::sqrt(std::max(0.0, covariance.bottomRightCorner<3, 3>().trace()));
  return motion.head<3>().norm() < std::clamp(3.0 * sigma_m, kLeast_m, kMost_m) &&
         motion.tail<3>().norm() < std::clamp(3.0 * sigma_rad, kLeast_rad, kMost_rad);
}

}  // namespace

Eigen::Isometry3d Standstill::update(const Eigen::Isometry3d& T_map_measured,
                                     const Eigen::Isometry3d& T_last_this,
                                     const Matrix6d& information) noexcept {
  constexpr int kMostAveraged = 50;
  const bool is_still = is_standing() ? is_none(difference(T_map_mean_, T_map_measured), information)
                                      : is_none(log_se3(T_last_this), information);
  if (!is_still) {
    num_still_ = 0;
    return T_map_measured;
  }
  ++num_still_;
  if (num_still_ == 1) {  // the pose before is the first of those that do not move
    T_map_mean_ = T_map_measured * T_last_this.inverse();
  }
  const Vector6d off = difference(T_map_mean_, T_map_measured);
  T_map_mean_ = perturb(T_map_mean_, off / std::min(num_still_ + 1, kMostAveraged));
  return is_standing() ? T_map_mean_ : T_map_measured;
}

}  // namespace pago::mapping
