// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace pago::perf {

/// Nearest rank, exact: the least value that at least `p` percent of all do not exceed. NaN of none.
inline double percentile(std::vector<double> values, double p) {
  if (values.empty()) return std::nan("");
  const double rank = std::ceil(p / 100.0 * static_cast<double>(values.size()));
  const auto at = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace pago::perf
