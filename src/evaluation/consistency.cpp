// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/consistency.hpp"

#include <cmath>

#include "matched_paths.hpp"
#include "no_value.hpp"
#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/evaluation/statistics.hpp"

namespace pago::evaluation {
namespace {

// Rotations in radians beside translations in metres: a factor of 1e6 between the variances is normal.
constexpr double kSmallestEigenvalueRatio = 1e-14;

bool is_positive_definite(const Matrix6d& covariance) {
  if (!covariance.allFinite()) return false;
  const Vector6d values = eigen_of(covariance).values;
  return values[0] > kSmallestEigenvalueRatio * values[5];
}

struct Sums {
  double nees = 0.0, translation = 0.0, rotation = 0.0;
  Vector6d error_per_sigma_sq = Vector6d::Zero();
  std::size_t num_inside = 0;
};

double squared_by(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& error) {
  return error.dot(covariance.inverse() * error);
}

/// The motion that ends at matched.poses[index].
void add_motion(Consistency& c,
                Sums& sums,
                const MatchedPose& from,
                const MatchedPose& to,
                const Matrix6d& covariance,
                std::size_t index) {
  if (!is_positive_definite(covariance)) {
    ++c.num_unusable;
    return;
  }
  const Vector6d error = log_se3(motion_error(from.T_world_sensor_truth, to.T_world_sensor_truth,
                                              *from.T_world_sensor_estimate, *to.T_world_sensor_estimate));
  const double nees = error.dot(solve_semidefinite(covariance, error));
  c.motions.push_back({index, nees});
  sums.nees += nees;
  sums.translation += squared_by(covariance.topLeftCorner<3, 3>(), error.head<3>());
  sums.rotation += squared_by(covariance.bottomRightCorner<3, 3>(), error.tail<3>());
  sums.error_per_sigma_sq += error.cwiseAbs2().cwiseQuotient(covariance.diagonal());
  static const double bound = chi_square_quantile(0.95, 6.0);
  if (nees <= bound) ++sums.num_inside;
}

void finish(Consistency& c, const Sums& sums) {
  const double n = static_cast<double>(c.motions.size());
  c.nees = sums.nees / n;
  c.translation_nees = sums.translation / n;
  c.rotation_nees = sums.rotation / n;
  c.error_per_sigma = (sums.error_per_sigma_sq / n).cwiseSqrt();
  c.inside_percent = 100.0 * static_cast<double>(sums.num_inside) / n;
  c.lower = chi_square_quantile(0.025, 6.0 * n) / n;
  c.upper = chi_square_quantile(0.975, 6.0 * n) / n;
}

}  // namespace

Consistency consistency_of(const MatchedTrajectories& matched, const std::vector<Matrix6d>& covariances) {
  Consistency c;
  Sums sums;
  const MatchedPose* before = nullptr;
  for (std::size_t i = 0; i < matched.poses.size(); ++i) {
    const MatchedPose& pose = matched.poses[i];
    if (!pose.T_world_sensor_estimate) continue;
    if (pose.estimate_row >= covariances.size())
      throw Error("covariances", "there are " + std::to_string(covariances.size()) +
                                     ", the estimate has a row " + std::to_string(pose.estimate_row));
    if (before != nullptr && pose.estimate_row == before->estimate_row + 1)
      add_motion(c, sums, *before, pose, covariances[pose.estimate_row], i);
    before = &pose;
  }
  if (c.motions.empty()) {
    c.nees = c.lower = c.upper = c.translation_nees = c.rotation_nees = c.inside_percent = kNoValue;
    c.error_per_sigma.setConstant(kNoValue);
  } else {
    finish(c, sums);
  }
  return c;
}

}  // namespace pago::evaluation
