// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "pago/core/text.hpp"
#include "pago/page/html.hpp"
#include "svg.hpp"

namespace pago::page {
namespace {

constexpr double kHeight_px = 280.0;
constexpr double kBelow_px = 42.0;
constexpr double kTallestMap_px = 520.0;
// Points closer together than this are drawn as one.
constexpr double kSpacing_px = 0.7;

struct Frame {
  Box box;
  Scale x, y;
  double height_px = kHeight_px;
};

std::pair<double, double> x_range(const Chart& chart) {
  std::vector<const std::vector<double>*> lists;
  for (const Series& series : chart.series) lists.push_back(&series.x);
  return range_of(lists, chart.x.is_log);
}

std::pair<double, double> y_range(const Chart& chart) {
  std::vector<double> extras;
  for (const Level& level : chart.levels) extras.push_back(level.y);
  std::vector<const std::vector<double>*> lists{&extras};
  for (const Series& series : chart.series) {
    lists.push_back(&series.y);
    if (series.mark == Mark::kBars && !chart.y.is_log) extras.push_back(0.0);
  }
  auto [min, max] = range_of(lists, chart.y.is_log);
  // Sizes of errors and the like are read against zero.
  if (!chart.y.is_log && !chart.is_map && min > 0.0 && min < 0.6 * max) min = 0.0;
  return {min, max};
}

Frame frame_of(const Chart& chart) {
  Frame frame;
  frame.box.bottom = frame.height_px - kBelow_px;
  const auto [x_min, x_max] = x_range(chart);
  const auto [y_min, y_max] = y_range(chart);
  frame.x = scale_for(chart.x, x_min, x_max, frame.box.left, frame.box.right);
  frame.y = scale_for(chart.y, y_min, y_max, frame.box.bottom, frame.box.top);
  return frame;
}

/// Both axes at the same scale: the picture gets as tall as the map needs, within limits, and the axis that
/// has room to spare shows more than the data need.
Frame map_frame_of(const Chart& chart) {
  Frame frame = frame_of(chart);
  Box& box = frame.box;
  const double width = frame.x.to - frame.x.from, height = frame.y.to - frame.y.from;
  const double wanted_px = (box.right - box.left) * height / width;
  const double drawn_px = std::clamp(wanted_px, 160.0, kTallestMap_px);
  frame.height_px = drawn_px + box.top + kBelow_px;
  box.bottom = box.top + drawn_px;
  const double per_px = std::max(width / (box.right - box.left), height / drawn_px);
  const auto widen = [per_px](Scale& scale, double size_px) {
    const double middle = 0.5 * (scale.from + scale.to);
    scale.from = middle - 0.5 * per_px * size_px;
    scale.to = middle + 0.5 * per_px * size_px;
  };
  widen(frame.x, box.right - box.left);
  widen(frame.y, drawn_px);
  frame.y.start_px = box.bottom;
  frame.y.end_px = box.top;
  return frame;
}

struct Point {
  double x, y;
  std::size_t index;
};

/// Runs of points without a gap.
std::vector<std::vector<Point>> runs_of(const Series& series, const Frame& frame) {
  std::vector<std::vector<Point>> runs(1);
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (frame.x.shows(series.x[i]) && frame.y.shows(series.y[i])) {
      runs.back().push_back({frame.x(series.x[i]), frame.y(series.y[i]), i});
    } else if (!runs.back().empty()) {
      runs.emplace_back();
    }
  }
  return runs;
}

/// Leaves out what cannot be seen. Both ends stay.
std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (const Point& point : points)
    if (kept.empty() || &point == &points.back() ||
        std::hypot(point.x - kept.back().x, point.y - kept.back().y) >= kSpacing_px)
      kept.push_back(point);
  return kept;
}

std::string polyline(const std::vector<Point>& points, const Series& series) {
  std::string svg = "<polyline class=\"line " + colour_class(series.colour) + "\" points=\"";
  for (const Point& point : thinned(points)) svg += format("%.1f,%.1f ", point.x, point.y);
  return svg + "\"><title>" + escape(series.name) + "</title></polyline>";
}

std::string dots(const std::vector<Point>& points, const Series& series) {
  std::string svg;
  for (const Point& point : points) {
    const std::string note = point.index < series.notes.size()
                                 ? series.notes[point.index]
                                 : number(series.x[point.index]) + ": " + number(series.y[point.index]);
    svg += format(R"(<circle class="dot %s" cx="%.1f" cy="%.1f" r="3"><title>)",
                  colour_class(series.colour).c_str(), point.x, point.y) +
           escape(series.name.empty() ? note : series.name + ", " + note) + "</title></circle>";
  }
  return svg;
}

std::string bars(const Series& series, const Frame& frame) {
  std::string svg;
  for (std::size_t i = 0; i + 1 < series.x.size() && i < series.y.size(); ++i) {
    if (!(series.y[i] > 0.0) || !frame.x.shows(series.x[i]) || !frame.x.shows(series.x[i + 1])) continue;
    const Box bar{frame.x(series.x[i]), frame.y(series.y[i]), frame.x(series.x[i + 1]), frame.box.bottom};
    const std::string where = number(series.x[i]) + " to " + number(series.x[i + 1]);
    svg +=
        rectangle(bar, "bar " + colour_class(series.colour),
                  (series.name.empty() ? "" : series.name + ", ") + where + ": " + format("%g", series.y[i]));
  }
  return svg;
}

std::string marks(const Series& series, const Frame& frame) {
  std::string svg =
      "<g data-series=\"" + colour_class(series.colour) + "\" data-name=\"" + escape(series.name) + "\">";
  if (series.mark == Mark::kBars) return svg + bars(series, frame) + "</g>";
  for (const std::vector<Point>& run : runs_of(series, frame)) {
    if (series.mark != Mark::kDots && run.size() > 1) svg += polyline(run, series);
    if (series.mark != Mark::kLine || run.size() == 1) svg += dots(run, series);
  }
  return svg + "</g>";
}

/// Their names stand at the right and the left end in turn, so that those of close ones do not overlap.
std::string levels(const Chart& chart, const Frame& frame) {
  std::string svg;
  for (std::size_t i = 0; i < chart.levels.size(); ++i) {
    const double y = frame.y(chart.levels[i].y);
    svg += format(R"(<line class="level" x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f"/>)", frame.box.left, y,
                  frame.box.right, y);
    svg += i % 2 == 0 ? text_at(frame.box.right - 4, y - 4, "tick end", chart.levels[i].name)
                      : text_at(frame.box.left + 4, y - 4, "tick", chart.levels[i].name);
  }
  return svg;
}

/// What the script needs to turn places back into values.
std::string attributes(const Chart& chart, const Frame& frame) {
  const auto scale = [](const Scale& s) {
    return format("%.9g %.9g %.1f %.1f %d", s.from, s.to, s.start_px, s.end_px, s.is_log ? 1 : 0);
  };
  return " data-x=\"" + scale(frame.x) + "\" data-y=\"" + scale(frame.y) + "\" data-map=\"" +
         (chart.is_map ? "1" : "0") + "\" data-label=\"" + escape(chart.x.label) + "\"";
}

}  // namespace

std::string figure(const Chart& chart) {
  const Frame frame = chart.is_map ? map_frame_of(chart) : frame_of(chart);
  std::string svg = x_axis(frame.x, frame.box, chart.x.label) + y_axis(frame.y, frame.box, chart.y.label) +
                    levels(chart, frame);
  Legend legend;
  for (const Series& series : chart.series) {
    svg += marks(series, frame);
    if (!series.name.empty()) legend.emplace_back(series.name, series.colour);
  }
  return figure_around(chart.title, chart.caption, legend, frame.height_px, attributes(chart, frame), svg);
}

}  // namespace pago::page
