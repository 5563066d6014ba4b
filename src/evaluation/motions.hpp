// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "pago/evaluation/association.hpp"
#include "pago/evaluation/mix_ups.hpp"

namespace pago::evaluation {

/// A rigid motion in the frame that moves: translation and rotation vector.
struct Motion6 {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero(), rotation_rad = Eigen::Vector3d::Zero();
};
Motion6 motion_between(const Eigen::Isometry3d& T_from, const Eigen::Isometry3d& T_to);

/// The same motion as both files have it.
struct MotionPair {
  Motion6 truth, estimate;
};

/// Between rows that follow each other, where both have an estimate.
std::vector<MotionPair> motion_pairs(const MatchedTrajectories& matched);

/// Sums of squares of the differences.
struct Misfit {
  double translation_sq = 0.0, rotation_sq = 0.0;
};
Misfit misfit_of(const std::vector<MotionPair>& pairs);

/// By how much `after` fits better, as a log-likelihood per motion with unknown noise: 0 no change, 1 for
/// e.g. a squared error of translation that fell to 1/e. Noise that is too small to matter is not divided by.
double gain(const Misfit& before, const Misfit& after, std::size_t num_motions);

/// The checks; each looks for one kind of mistake.
std::optional<MixUp> find_time_shift(const MatchedTrajectories& matched, double row_interval_s);
std::vector<MixUp> find_body_mix_ups(const std::vector<MotionPair>& pairs);

}  // namespace pago::evaluation
