// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "axes.hpp"

namespace pago::page {

Series histogram(const std::vector<double>& values, const std::vector<double>& edges) {
  Series series{.name = {}, .x = edges, .y = {}, .colour = 0, .mark = Mark::kBars};
  if (edges.size() < 2) return series;
  series.y.assign(edges.size() - 1, 0.0);
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
    ++series.y[static_cast<std::size_t>(above - edges.begin()) - 1];
  }
  return series;
}

Series histogram(const std::vector<double>& values, std::size_t num_bins, bool is_log) {
  const Scale shown{.is_log = is_log};
  std::vector<double> usable;
  std::copy_if(values.begin(), values.end(), std::back_inserter(usable),
               [&](double value) { return shown.shows(value); });
  if (usable.empty() || num_bins == 0) return histogram({}, std::vector<double>{});
  const auto [least, greatest] = std::minmax_element(usable.begin(), usable.end());
  double min = *least, max = *greatest;
  if (min == max) max = is_log ? 1.1 * min : min + std::max(1e-9, 0.1 * std::abs(min));
  std::vector<double> edges(num_bins + 1);
  for (std::size_t i = 0; i <= num_bins; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(num_bins);
    edges[i] = is_log ? min * std::pow(max / min, part) : min + part * (max - min);
  }
  return histogram(usable, edges);
}

}  // namespace pago::page
