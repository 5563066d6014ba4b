// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/evaluation/evaluation.hpp"

namespace pago::evaluation {

/// One figure of several evaluations, in their order; the first is what the others are compared with.
struct ComparedFigure {
  std::string name, unit;      ///< "t_rel", "%"
  std::string meaning;         ///< one line
  std::vector<double> values;  ///< NaN where an evaluation does not have it

  /// values[i] - values[0]; NaN where one of them is.
  double difference(std::size_t i) const { return values[i] - values[0]; }
};

/// The figures by which estimates are judged, all of them better when smaller; those that no evaluation has
/// are left out.
std::vector<ComparedFigure> compared_figures(const std::vector<Evaluation>& evaluations);

/// A table for the terminal: a row per figure, a column per estimate, the difference from the first one in
/// brackets; then every warning, with the number of its estimate.
std::string comparison_report(const std::vector<Evaluation>& evaluations);

}  // namespace pago::evaluation
