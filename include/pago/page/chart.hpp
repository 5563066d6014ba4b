// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// Charts as HTML figures with static SVG inside, for the pages of html.hpp. A figure is readable without
/// script; with the page's script it tells values under the pointer and hides series by their legend.
/// [set-up] everything here allocates. The same data give the same bytes.
namespace pago::page {

/// Index into the palette of eight, which is told apart by most colour-blind readers too; higher ones start
/// again.
using Colour = std::size_t;
/// That of what others are compared with: the truth.
inline constexpr Colour kNeutral = static_cast<Colour>(-1);

enum class Mark {
  kLine,
  kDots,
  kLineAndDots,
  kBars,  ///< a histogram: x are the bins' edges, one more than y; y their heights
};

struct Series {
  std::string name;  ///< empty: not in the legend
  std::vector<double> x, y;
  Colour colour = 0;
  Mark mark = Mark::kLine;
  /// Dots only: what each is about; empty or one per dot.
  std::vector<std::string> notes{};
};

struct Axis {
  std::string label;  ///< with its unit: "distance, m"
  bool is_log = false;
};

/// A line across the chart: a limit, a goal, the right value.
struct Level {
  double y = 0.0;
  std::string name;
};

/// Two quantities against each other. Points that are not finite, or not positive on a logarithmic axis, are
/// left out and interrupt the line.
struct Chart {
  std::string title;
  std::string caption{};  ///< below; what to look for
  Axis x, y;
  std::vector<Series> series;
  std::vector<Level> levels{};
  bool is_map = false;  ///< same scale on both axes; values are told by position, not by x
};
std::string figure(const Chart& chart);

/// Bars side by side: a group per category, a bar per series.
struct BarChart {
  struct Bars {
    std::string name;
    std::vector<double> values;  ///< one per category; not finite: no bar
    Colour colour = 0;
  };
  std::string title;
  std::string caption{};
  std::string label;  ///< of the values, with their unit
  std::vector<std::string> categories;
  std::vector<Bars> series;
};
std::string figure(const BarChart& chart);

/// Bins of equal width, or of equal ratio when `is_log`, over the values' range: edges and counts for
/// Mark::kBars. Values that are not finite, or not positive when is_log, are left out.
Series histogram(const std::vector<double>& values, std::size_t num_bins, bool is_log = false);
/// The same with given edges, so that several histograms can be laid over each other; values outside are
/// counted in the outermost bins.
Series histogram(const std::vector<double>& values, const std::vector<double>& edges);

}  // namespace pago::page
