// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/evaluation/association.hpp"

namespace pago::evaluation {

/// The rows with an estimate, one after the other.
struct MatchedPaths {
  std::vector<Eigen::Isometry3d> truth, estimate;
};
MatchedPaths paths_of(const MatchedTrajectories& matched);

/// Metres travelled along the truth up to each row, with an estimate or without.
std::vector<double> true_distances_m(const MatchedTrajectories& matched);

/// Index from `first` on, of the distance closest to the target; the first one of equals. Distances must not
/// fall and `first` must be in them.
std::size_t closest_distance(const std::vector<double>& distance_m, std::size_t first, double target_m);

/// inv(true motion) * estimated motion: what perturbs the true motion at its end, in the sensor frame there.
Eigen::Isometry3d motion_error(const Eigen::Isometry3d& T_truth_from,
                               const Eigen::Isometry3d& T_truth_to,
                               const Eigen::Isometry3d& T_estimate_from,
                               const Eigen::Isometry3d& T_estimate_to);

}  // namespace pago::evaluation
