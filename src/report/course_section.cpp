// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "charts.hpp"
#include "pago/page/html.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::report {
namespace {

using evaluation::CoursePoint;

page::Series truth_series(const std::vector<ScoredRun>& runs) {
  // The run that was matched to most of the truth shows most of it.
  const ScoredRun* widest = &runs.front();
  for (const ScoredRun& run : runs)
    if (run.score.course.size() > widest->score.course.size()) widest = &run;
  page::Series series{.name = "truth", .x = {}, .y = {}, .colour = page::kNeutral};
  for (const CoursePoint& point : widest->score.course) {
    series.x.push_back(point.truth_m.x());
    series.y.push_back(point.truth_m.y());
  }
  return series;
}

page::Series start_of(const page::Series& truth) {
  return {.name = "start",
          .x = {truth.x.front()},
          .y = {truth.y.front()},
          .colour = page::kNeutral,
          .mark = page::Mark::kDots,
          .notes = {"the first pose"}};
}

page::Chart plan(const std::vector<ScoredRun>& runs) {
  page::Chart chart{.title = "Plan",
                    .caption = "Seen from above, aligned by " +
                               std::string(to_string(runs.front().score.course_alignment)) +
                               ". The truth is dotted; the dot is its first pose.",
                    .x = {.label = "x, m"},
                    .y = {.label = "y, m"},
                    .series = {},
                    .levels = {},
                    .is_map = true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    page::Series series{.name = runs[i].name, .x = {}, .y = {}, .colour = i};
    for (const CoursePoint& point : runs[i].score.course) {
      series.x.push_back(point.estimate_m.x());
      series.y.push_back(point.estimate_m.y());
    }
    chart.series.push_back(std::move(series));
  }
  const page::Series truth = truth_series(runs);
  page::Series start = start_of(truth);
  start.name.clear();
  chart.series.push_back(truth);
  chart.series.push_back(std::move(start));
  return chart;
}

page::Chart height(const std::vector<ScoredRun>& runs) {
  page::Chart chart =
      over_distance(runs, "Height", "z, m", [](const CoursePoint& p) { return p.estimate_m.z(); });
  page::Chart truth =
      over_distance({runs.front()}, "", "", [](const CoursePoint& p) { return p.truth_m.z(); });
  truth.series.front().name = "truth";
  truth.series.front().colour = page::kNeutral;
  chart.series.push_back(std::move(truth.series.front()));
  chart.caption = "Under the same alignment.";
  return chart;
}

}  // namespace

std::string trajectory_section(const std::vector<ScoredRun>& runs) {
  return page::section("Where it went", "", page::grid(figure(plan(runs)) + figure(height(runs))));
}

std::string course_section(const std::vector<ScoredRun>& runs) {
  page::Chart error =
      over_distance(runs, "Position error", "m", [](const CoursePoint& p) { return p.error_m; });
  error.caption = "Distance to the truth, aligned by " +
                  std::string(to_string(runs.front().score.course_alignment)) +
                  ": ATE is its root mean square.";
  page::Chart z =
      over_distance(runs, "Drift in height", "m", [](const CoursePoint& p) { return p.drift_m.z(); });
  z.caption = "Since the start, first poses laid over each other. Ground points hold height, roll and pitch.";
  const auto angle = [&](const char* title, Eigen::Index axis) {
    return figure(over_distance(runs, title, "degrees",
                                [axis](const CoursePoint& p) { return p.drift_rpy_rad[axis] * kDegPerRad; }));
  };
  return page::section("Where it errs", "",
                       page::grid(figure(error) + figure(z) + angle("Drift in roll", 0) +
                                  angle("Drift in pitch", 1) + angle("Drift in yaw", 2)));
}

}  // namespace pago::report
