// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "charts.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/comparison.hpp"
#include "pago/page/html.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::report {
namespace {

using namespace evaluation;
using page::Cell;
using page::number;

std::vector<Cell> row(std::string name, std::initializer_list<double> values) {
  std::vector<Cell> cells{{std::move(name)}};
  for (const double value : values) cells.push_back({number(value)});
  return cells;
}

std::string absolute_table(const Evaluation& e) {
  page::Table table{
      {"aligned by", "rmse, m", "mean", "median", "std", "min", "max", "x rmse", "y", "z", "turn, deg"}, {}};
  for (const AbsoluteErrors& a : e.absolute)
    table.rows.push_back(
        row(std::string(to_string(a.alignment)),
            {a.rmse_m, a.mean_m, a.median_m, a.deviation_m, a.min_m, a.max_m, a.axis_rmse_m.x(),
             a.axis_rmse_m.y(), a.axis_rmse_m.z(), a.rotation_rmse_rad * kDegPerRad}));
  return "<h3>Absolute error (ATE; evo's APE)</h3>" + page::table(table);
}

std::vector<Cell> rates_row(const std::string& name, const DriftRates& r) {
  std::vector<Cell> cells = row(name, {r.t_rel_percent, r.axis_percent.x(), r.axis_percent.y(),
                                       r.axis_percent.z(), r.r_rel_deg_per_100m, r.axis_deg_per_100m.x(),
                                       r.axis_deg_per_100m.y(), r.axis_deg_per_100m.z()});
  cells.insert(cells.begin() + 1, {std::to_string(r.num_segments)});
  return cells;
}

std::string relative_table(const Evaluation& e) {
  if (e.relative.segments.empty()) return {};
  page::Table table{
      {"length, m", "segments", "t_rel, %", "x", "y", "z", "r_rel, deg/100 m", "roll", "pitch", "yaw"}, {}};
  for (const DriftRates& rates : e.relative.by_length)
    table.rows.push_back(rates_row(format("%g", rates.length_m), rates));
  table.rows.push_back(rates_row("all", e.relative.overall));
  return "<h3>Relative error of KITTI's segments</h3>" + page::table(table);
}

std::string sub_trajectory_table(const Evaluation& e) {
  if (e.sub_trajectories.empty()) return {};
  page::Table table{{"length, m", "pairs", "translation, %: mean", "median", "rotation, deg/100 m: mean",
                     "median", "yaw, deg", "tilt, deg"},
                    {}};
  for (const SubTrajectoryErrors& s : e.sub_trajectories) {
    table.rows.push_back(
        row(format("%.2f", s.length_m),
            {s.translation_percent.mean, s.translation_percent.median, s.rotation_deg_per_100m.mean,
             s.rotation_deg_per_100m.median, s.yaw_deg.mean, s.tilt_deg.mean}));
    table.rows.back().insert(table.rows.back().begin() + 1, {std::to_string(s.translation_m.count)});
  }
  return "<h3>Relative error of rpg's sub-trajectories</h3>" + page::table(table);
}

std::string pair_table(const Evaluation& e) {
  if (e.pairs.translation_m.count == 0) return {};
  page::Table table{{"", "rmse", "mean", "median", "std", "min", "max"}, {}};
  const auto add = [&](const char* name, const Statistics& s) {
    table.rows.push_back(row(name, {s.rmse, s.mean, s.median, s.deviation, s.min, s.max}));
  };
  add("translation, m", e.pairs.translation_m);
  add("rotation, deg", e.pairs.rotation_deg);
  add("point distance, m", e.pairs.point_distance_m);
  return format("<h3>Relative error of evo's pairs (%g %s, %zu pairs)</h3>", e.pair_options.delta,
                e.pair_options.unit == PairOptions::Unit::kMetres ? "m" : "rows",
                e.pairs.translation_m.count) +
         page::table(table);
}

std::string of_run(const ScoredRun& run) {
  const Evaluation& e = run.score;
  return page::paragraph(
             "Truth: " + e.truth_name + format(" (%zu poses)", e.truth_poses) +
             ". Estimate: " + e.estimate_name +
             format(" (%zu poses). Matched: %zu of %zu rows, ", e.estimate_poses, e.num_matched, e.num_rows) +
             e.how + ".") +
         relative_table(e) + absolute_table(e) + sub_trajectory_table(e) + pair_table(e);
}

}  // namespace

std::string figures_section(const std::vector<ScoredRun>& runs) {
  std::string html;
  for (const ScoredRun& run : runs) html += page::details(run.name + ": every figure", of_run(run));
  return page::section("All figures", "", html);
}

std::string comparison_table(const std::vector<ScoredRun>& runs) {
  std::vector<Evaluation> scores;
  page::Table table{{""}, {}};
  for (const ScoredRun& run : runs) {
    scores.push_back(run.score);
    table.head.push_back(run.name);
  }
  for (const ComparedFigure& figure : compared_figures(scores)) {
    std::vector<Cell> cells{{figure.name + ", " + figure.unit}};
    double best = HUGE_VAL;
    for (const double value : figure.values)
      if (std::isfinite(value)) best = std::min(best, value);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Cell cell{number(figure.values[i])};
      cell.is_best = runs.size() > 1 && figure.values[i] == best;
      const double difference = i == 0 ? std::nan("") : figure.difference(i);
      if (std::isfinite(difference)) {
        cell.note = page::difference(difference);
        cell.tone = difference < 0.0   ? page::Tone::kGood
                    : difference > 0.0 ? page::Tone::kBad
                                       : page::Tone::kNone;
      }
      cells.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(cells));
  }
  return page::table(table);
}

}  // namespace pago::report
