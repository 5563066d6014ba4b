// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>

#include "charts.hpp"
#include "pago/core/text.hpp"
#include "pago/page/html.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::report {
namespace {

using evaluation::DriftRates;
using Rates = std::vector<DriftRates> evaluation::RelativeErrors::*;

/// One point per entry of a list of rates.
std::string by(const std::vector<ScoredRun>& runs,
               const std::string& title,
               const std::string& x_label,
               const std::string& y_label,
               Rates rates,
               double DriftRates::*x,
               double DriftRates::*y) {
  page::Chart chart{.title = title, .x = {.label = x_label}, .y = {.label = y_label}, .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    page::Series series{
        .name = runs[i].name, .x = {}, .y = {}, .colour = i, .mark = page::Mark::kLineAndDots};
    for (const DriftRates& entry : runs[i].score.relative.*rates) {
      series.x.push_back(entry.*x);
      series.y.push_back(entry.*y);
      series.notes.push_back(format("%g: ", entry.*x) + page::number(entry.*y) +
                             format(" (%zu segments)", entry.num_segments));
    }
    chart.series.push_back(std::move(series));
  }
  return figure(chart);
}

std::string by_axis(const std::vector<ScoredRun>& runs,
                    const std::string& title,
                    const std::string& label,
                    std::vector<std::string> axes,
                    Eigen::Vector3d DriftRates::*figure_of) {
  page::BarChart chart{
      .title = title, .caption = {}, .label = label, .categories = std::move(axes), .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Eigen::Vector3d& v = runs[i].score.relative.overall.*figure_of;
    chart.series.push_back({runs[i].name, {v.x(), v.y(), v.z()}, i});
  }
  return figure(chart);
}

}  // namespace

std::string segment_section(const std::vector<ScoredRun>& runs) {
  bool has_segments = false;
  for (const ScoredRun& run : runs) has_segments = has_segments || !run.score.relative.segments.empty();
  if (!has_segments) return {};
  const Rates lengths = &evaluation::RelativeErrors::by_length;
  const Rates speeds = &evaluation::RelativeErrors::by_speed;
  const std::string t = "translation error, %", r = "rotation error, deg/100 m";
  std::string figures =
      by(runs, "Translation by length", "segment length, m", t, lengths, &DriftRates::length_m,
         &DriftRates::t_rel_percent) +
      by(runs, "Rotation by length", "segment length, m", r, lengths, &DriftRates::length_m,
         &DriftRates::r_rel_deg_per_100m) +
      by(runs, "Translation by speed", "speed, m/s", t, speeds, &DriftRates::speed_m_per_s,
         &DriftRates::t_rel_percent) +
      by(runs, "Rotation by speed", "speed, m/s", r, speeds, &DriftRates::speed_m_per_s,
         &DriftRates::r_rel_deg_per_100m) +
      by_axis(runs, "Translation by axis", "%", {"x ahead", "y left", "z up"}, &DriftRates::axis_percent) +
      by_axis(runs, "Rotation by axis", "deg/100 m", {"roll", "pitch", "yaw"},
              &DriftRates::axis_deg_per_100m);
  return page::section("How fast it drifts",
                       "Errors of KITTI's segments: motion over a length of the true path, of that length. "
                       "Rotation is in degrees per hundred metres throughout; KISS-ICP prints degrees per "
                       "metre, a hundredth of that.",
                       page::grid(figures));
}

}  // namespace pago::report
