// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "charts.hpp"

#include <algorithm>

namespace pago::report {
namespace {

bool is_long(const std::vector<ScoredRun>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [](const ScoredRun& run) { return run.score.truth_motion.path_length_m > 3000.0; });
}

}  // namespace

double distance_scale(const std::vector<ScoredRun>& runs) {
  return is_long(runs) ? 1e-3 : 1.0;
}

std::string distance_label(const std::vector<ScoredRun>& runs) {
  return is_long(runs) ? "distance travelled, km" : "distance travelled, m";
}

page::Chart over_distance(const std::vector<ScoredRun>& runs,
                          const std::string& title,
                          const std::string& unit_label,
                          const std::function<double(const evaluation::CoursePoint&)>& value) {
  page::Chart chart{
      .title = title, .x = {.label = distance_label(runs)}, .y = {.label = unit_label}, .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    page::Series series{.name = runs[i].name, .x = {}, .y = {}, .colour = i};
    for (const evaluation::CoursePoint& point : runs[i].score.course) {
      series.x.push_back(point.distance_m * distance_scale(runs));
      series.y.push_back(value(point));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace pago::report
