// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pago/core/estimate.hpp"
#include "pago/evaluation/association.hpp"

namespace pago::evaluation {

/// Normalised squared error of one motion, from the estimate's pose before to this one.
struct MotionNees {
  std::size_t index = 0;  ///< into MatchedTrajectories::poses, of the motion's end
  double nees = 0.0;
};

/// Whether the covariance that an estimate reports of its motions fits their true errors (NEES, normalised
/// estimation error squared: Bar-Shalom, Li, Kirubarajan 2001, section 5.4). With a right covariance the mean
/// NEES is the number of degrees of freedom; above it the estimate is too sure of itself, below too modest.
struct Consistency {
  std::vector<MotionNees> motions;
  std::size_t num_unusable = 0;  ///< motions whose covariance is not positive definite
  double nees = 0.0;             ///< mean, 6 degrees of freedom; NaN without motions
  /// 95 % of right estimates have their mean in here, if errors of different sweeps are independent.
  double lower = 0.0, upper = 0.0;
  double translation_nees = 0.0, rotation_nees = 0.0;  ///< of each half alone, 3 degrees of freedom
  /// x y z roll pitch yaw: root mean square of error / sigma, 1 when right. Says which direction is wrong.
  Vector6d error_per_sigma = Vector6d::Zero();
  double inside_percent = 0.0;  ///< motions whose own NEES is below its 95 % quantile

  bool is_consistent() const noexcept { return nees >= lower && nees <= upper; }
};

/// `covariances`: row by row of the estimate's file, of the motion since the row before, right perturbation
/// in the sensor frame, order x y z roll pitch yaw (Estimate::covariance). Motions between rows of the
/// estimate that do not follow each other are left out. Error when there are fewer covariances than rows.
Consistency consistency_of(const MatchedTrajectories& matched, const std::vector<Matrix6d>& covariances);

}  // namespace pago::evaluation
