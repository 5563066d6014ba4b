// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/evaluation/association.hpp"
#include "pago/evaluation/statistics.hpp"

namespace pago::evaluation {

/// The choice of sub-trajectories of rpg_trajectory_evaluation (Zhang and Scaramuzza 2018), which the PaGO
/// paper names.
struct SubTrajectoryOptions {
  std::vector<double> parts{0.1, 0.2, 0.3, 0.4, 0.5};  ///< of the true path's length, each in (0, 1]
  std::vector<double> lengths_m;                       ///< instead of parts, where not empty; each > 0
  double max_difference = 0.2;  ///< the end must be this close to the length; of the length, > 0
};

/// Errors over all sub-trajectories of one length. The motion's error is turned into the estimate's world,
/// where the vertical separates yaw from tilt; that world's z must point up.
struct SubTrajectoryErrors {
  double length_m = 0.0;
  Statistics translation_m, translation_percent;
  Statistics rotation_deg, rotation_deg_per_100m;
  Statistics yaw_deg, tilt_deg;  ///< magnitudes; tilt (rpg: gravity) is sqrt(roll^2 + pitch^2)
};

/// One entry per length. From every row to the row whose distance along the true path is closest to the
/// length; lengths from parts are cut off to whole centimetres, as there. Lengths without any sub-trajectory
/// are left out. Error for parts, lengths and differences out of range.
std::vector<SubTrajectoryErrors> sub_trajectory_errors(const MatchedTrajectories& matched,
                                                       const SubTrajectoryOptions& options = {});

}  // namespace pago::evaluation
