// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "pago/page/html.hpp"
#include "svg.hpp"

namespace pago::page {

std::string figure(const BarChart& chart) {
  constexpr double kHeight_px = 250.0, kBelow_px = 26.0, kGap = 0.25;
  Box box;
  box.bottom = kHeight_px - kBelow_px;
  const std::vector<double> zero{0.0};
  std::vector<const std::vector<double>*> lists{&zero};
  for (const BarChart::Bars& series : chart.series) lists.push_back(&series.values);
  const auto [min, max] = range_of(lists, false);
  const Scale y = scale_for({.label = {}}, min, max, box.bottom, box.top);

  std::string svg = y_axis(y, box, chart.label);
  const double group_px =
      (box.right - box.left) / static_cast<double>(std::max<std::size_t>(1, chart.categories.size()));
  const double bar_px =
      group_px * (1.0 - kGap) / static_cast<double>(std::max<std::size_t>(1, chart.series.size()));
  for (std::size_t i = 0; i < chart.categories.size(); ++i)
    svg += text_at(box.left + group_px * (static_cast<double>(i) + 0.5), box.bottom + 18, "label mid",
                   chart.categories[i]);
  Legend legend;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const BarChart::Bars& series = chart.series[k];
    if (!series.name.empty()) legend.emplace_back(series.name, series.colour);
    svg += "<g data-series=\"" + colour_class(series.colour) + "\">";
    for (std::size_t i = 0; i < std::min(chart.categories.size(), series.values.size()); ++i) {
      if (!std::isfinite(series.values[i])) continue;
      const double left =
          box.left + group_px * (static_cast<double>(i) + 0.5 * kGap) + bar_px * static_cast<double>(k);
      const double end = y(series.values[i]), base = y(0.0);
      svg += rectangle({left, std::min(end, base), left + 0.92 * bar_px, std::max(end, base)},
                       "solid " + colour_class(series.colour),
                       series.name + (series.name.empty() ? "" : ", ") + chart.categories[i] + ": " +
                           number(series.values[i]));
    }
    svg += "</g>";
  }
  return figure_around(chart.title, chart.caption, legend, kHeight_px, "", svg);
}

}  // namespace pago::page
