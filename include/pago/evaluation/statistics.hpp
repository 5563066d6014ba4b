// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace pago::evaluation {

/// What evo and rpg_trajectory_evaluation print of a list of errors. NaN when the list is empty.
struct Statistics {
  std::size_t count = 0;
  double rmse = 0.0, mean = 0.0, median = 0.0;
  double deviation = 0.0;  ///< standard deviation, divided by n
  double min = 0.0, max = 0.0;
};
Statistics statistics_of(std::vector<double> values);

/// The value that the fraction `p` in [0, 1] of a chi-square distribution lies below. Exact to about 1e-10.
double chi_square_quantile(double p, double degrees_of_freedom);

}  // namespace pago::evaluation
