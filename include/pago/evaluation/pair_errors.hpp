// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "pago/evaluation/association.hpp"
#include "pago/evaluation/statistics.hpp"

namespace pago::evaluation {

/// Which poses evo_rpe compares. Only matched rows count, as if the others were not in the files.
struct PairOptions {
  enum class Unit { kMetres, kRows };
  Unit unit = Unit::kMetres;
  double delta = 100.0;           ///< > 0; a whole number for rows
  bool all_pairs = false;         ///< a pair from every pose (--all_pairs), not one after the other
  double tolerance = 0.1;         ///< with all_pairs in metres: of delta (--delta_tol)
  bool pairs_from_truth = false;  ///< along the true path (--pairs_from_reference), not the estimate's
};

/// Indices of the matched rows, counted without the holes. Chained pairs in metres: the path is measured from
/// the first pose, and the first pair STARTS where it first reaches delta, as evo has it.
std::vector<std::pair<std::size_t, std::size_t>> evo_pairs(const std::vector<Eigen::Isometry3d>& path,
                                                           const PairOptions& options);

/// evo's relative pose error: E = inv(true motion) * estimated motion.
struct PairErrors {
  Statistics translation_m;     ///< -r trans_part
  Statistics rotation_deg;      ///< -r angle_deg
  Statistics point_distance_m;  ///< -r point_distance: of the distance between the pair's positions
};

/// NaN statistics where the path is too short for a pair. Error for a delta or tolerance that is not greater
/// than 0, and for rows that are not whole.
PairErrors pair_errors(const MatchedTrajectories& matched, const PairOptions& options = {});

}  // namespace pago::evaluation
