// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/evaluation/ground_metrics.hpp"
#include "pago/evaluation/relative_error.hpp"
#include "pago/output/sweep_record.hpp"

namespace pago::app {

/// What the demo is judged by.
struct DemoBounds {
  double max_drift_percent = 4.0;  ///< the paper's own front end: 3 to 6 %
  double min_ground_f1 = 0.95;     ///< protocol B
};

/// How far the refined poses drift from the truth: means over 50 and 100 m of the path.
struct DemoAccuracy {
  std::size_t num_poses = 0, num_rows = 0;  ///< estimated; of the truth
  double path_m = 0.0, ate_m = 0.0;
  evaluation::DriftRates drift;
};

/// `truth`: the rows of the drive's truth file for the instant of the poses; row i belongs to rotation i.
DemoAccuracy judge_accuracy(const std::vector<output::SweepRecord>& records, const std::string& truth);

}  // namespace pago::app
