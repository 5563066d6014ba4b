// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "pago/evaluation/ground_report.hpp"
#include "pago/page/chart.hpp"
#include "pago/page/html.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::report {
namespace {

using evaluation::GroundComparison;
using evaluation::GroundScore;

std::string along(const GroundComparison& comparison, const std::string& title, double GroundScore::*value) {
  page::Chart chart{.title = title, .x = {.label = "frame"}, .y = {.label = "%"}, .series = {}};
  for (std::size_t i = 0; i < comparison.methods.size(); ++i) {
    page::Series series{.name = comparison.methods[i].method, .x = {}, .y = {}, .colour = i};
    for (std::size_t k = 0; k < comparison.frames.size(); ++k) {
      const double score = ground_score(comparison.methods[i].counts[k]).*value;
      if (std::isnan(score)) continue;  // not defined: no dot
      series.x.push_back(static_cast<double>(comparison.frames[k]));
      series.y.push_back(100.0 * score);
    }
    chart.series.push_back(std::move(series));
  }
  return figure(chart);
}

page::Cell percent(double mean, double deviation) {
  return {evaluation::percent_text(mean), "± " + evaluation::percent_text(deviation)};
}

std::string table(const GroundComparison& comparison) {
  page::Table table{{"mean over frames, %", "precision", "recall", "F1", "accuracy", "F1 of all points"}, {}};
  const std::vector<evaluation::GroundSummary> all = ground_summaries(comparison);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const GroundScore &mean = all[i].mean, &deviation = all[i].deviation;
    table.rows.push_back({{comparison.methods[i].method},
                          percent(mean.precision, deviation.precision),
                          percent(mean.recall, deviation.recall),
                          percent(mean.f1, deviation.f1),
                          percent(mean.accuracy, deviation.accuracy),
                          {evaluation::percent_text(all[i].pooled.f1)}});
  }
  return page::table(table);
}

std::string block(const GroundComparison& comparison) {
  const std::string rows = table(comparison);
  return page::section(
      "Ground against the labels, protocol " + std::string(to_string(comparison.protocol)),
      "Here " + std::string(vegetation_rule(comparison.protocol)) + "; " + frames_text(comparison) +
          ". ± is the standard deviation over the frames. The two protocols count vegetation differently: "
          "figures of A and of B must not be compared.",
      rows + page::grid(along(comparison, "Precision over the drive", &GroundScore::precision) +
                        along(comparison, "Recall over the drive", &GroundScore::recall)));
}

}  // namespace

std::string ground_section(std::span<const GroundComparison> comparisons) {
  std::string html;
  for (const GroundComparison& comparison : comparisons) html += block(comparison);
  return html;
}

std::string ground_page(const std::string& title,
                        std::span<const GroundComparison> comparisons,
                        const std::string& made_by) {
  return page::document(
      {title, "How ground masks agree with the labels.", ground_section(comparisons), made_by});
}

}  // namespace pago::report
