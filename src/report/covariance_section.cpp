// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "charts.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/statistics.hpp"
#include "pago/page/html.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::report {
namespace {

using evaluation::Consistency;

bool is_judged(const ScoredRun& run) {
  return run.score.consistency && !run.score.consistency->motions.empty();
}

page::Chart along(const std::vector<ScoredRun>& runs) {
  page::Chart chart{.title = "Normalised squared error of each motion",
                    .caption = "Right on average: 6. One motion in twenty may lie above the upper line.",
                    .x = {.label = "row"},
                    .y = {.label = "NEES", .is_log = true},
                    .series = {},
                    .levels = {{6.0, "right mean"}, {evaluation::chi_square_quantile(0.95, 6.0), "95 %"}}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!is_judged(runs[i])) continue;
    page::Series series{.name = runs[i].name, .x = {}, .y = {}, .colour = i};
    for (const evaluation::MotionNees& motion : runs[i].score.consistency->motions) {
      series.x.push_back(static_cast<double>(motion.index));
      series.y.push_back(motion.nees);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

page::BarChart per_sigma(const std::vector<ScoredRun>& runs) {
  page::BarChart chart{.title = "Error per reported sigma",
                       .caption = "Right: 1. Above, the estimate is too sure of that direction.",
                       .label = "rms of error / sigma",
                       .categories = {"x", "y", "z", "roll", "pitch", "yaw"},
                       .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!is_judged(runs[i])) continue;
    const Vector6d& r = runs[i].score.consistency->error_per_sigma;
    chart.series.push_back({runs[i].name, {r.data(), r.data() + 6}, i});
  }
  return chart;
}

std::string table(const std::vector<ScoredRun>& runs) {
  page::Table table{
      {"", "NEES (6)", "95 % of right ones", "translation (3)", "rotation (3)", "below 95 % bound"}, {}};
  for (const ScoredRun& run : runs) {
    if (!is_judged(run)) continue;
    const Consistency& c = *run.score.consistency;
    table.rows.push_back({{run.name},
                          {page::number(c.nees)},
                          {page::number(c.lower) + " to " + page::number(c.upper)},
                          {page::number(c.translation_nees)},
                          {page::number(c.rotation_nees)},
                          {format("%.1f %%", c.inside_percent)}});
  }
  return page::table(table);
}

}  // namespace

std::string covariance_section(const std::vector<ScoredRun>& runs) {
  if (std::none_of(runs.begin(), runs.end(), is_judged)) return {};
  return page::section("Does it know how good it is?",
                       "The covariance that is reported with each pose, against the true error of the motion "
                       "since the pose before (NEES).",
                       table(runs) + page::grid(figure(along(runs)) + figure(per_sigma(runs))));
}

}  // namespace pago::report
