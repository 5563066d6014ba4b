// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pago/evaluation/ground_report.hpp"
#include "pago/report/run.hpp"

namespace pago::report {

/// What `pago evaluate --html` writes: how good the estimates are, where they err, and whatever else their
/// runs left: latency, ground masks against labels. The first run is what the others are compared with.
struct EvaluationPage {
  std::vector<ScoredRun> scored;                     ///< at least one
  std::vector<TimedRun> timed;                       ///< one for each of them, maybe without files
  std::vector<evaluation::GroundComparison> ground;  ///< may be empty
  std::string made_by;                               ///< program, version and command
};
std::string evaluation_page(const EvaluationPage& page);

/// The parts. They must be given at least one run; all sections tell runs apart by colour in their order.
std::string trajectory_section(const std::vector<ScoredRun>& runs);  ///< plan and height over the truth
std::string course_section(const std::vector<ScoredRun>& runs);      ///< error and drift over the distance
std::string segment_section(const std::vector<ScoredRun>& runs);     ///< by length, by speed, by axis
std::string covariance_section(const std::vector<ScoredRun>& runs);  ///< empty where no run has covariances
std::string figures_section(const std::vector<ScoredRun>& runs);     ///< every number in tables

/// Figures side by side, with the difference from the first run and the best one marked.
std::string comparison_table(const std::vector<ScoredRun>& runs);

/// Precision and recall over the frames, a table with means and spreads; a block per comparison, since what
/// two protocols count is never shown side by side. Error for a comparison that is not one.
std::string ground_section(std::span<const evaluation::GroundComparison> comparisons);

/// What `pago segment` leaves: these blocks as a page. `title` is plain text.
std::string ground_page(const std::string& title,
                        std::span<const evaluation::GroundComparison> comparisons,
                        const std::string& made_by);

}  // namespace pago::report
