// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/evaluation_page.hpp"

#include <cmath>

#include "charts.hpp"
#include "pago/core/text.hpp"
#include "pago/page/html.hpp"
#include "pago/report/latency.hpp"

namespace pago::report {
namespace {

using evaluation::Alignment;
using evaluation::Evaluation;
using page::number;

std::string length_text(double metres) {
  return metres < 1000.0 ? format("%.0f m", metres) : format("%.2f km", metres / 1000.0);
}

/// What a reader wants to know first, in one sentence.
std::string lead(const ScoredRun& run) {
  const Evaluation& e = run.score;
  std::string text =
      format("Over %s in %zu poses ", length_text(e.truth_motion.path_length_m).c_str(), e.num_matched);
  if (!e.relative.segments.empty())
    text += "the estimate drifts by " + number(e.relative.overall.t_rel_percent) + " % of the way and " +
            number(e.relative.overall.r_rel_deg_per_100m) + " degrees per 100 m; ";
  return text + "it stays within " + number(e.ate(Alignment::kSe3).rmse_m) +
         " m (root mean square) of the truth once the two are laid over each other.";
}

std::string lead(const std::vector<ScoredRun>& runs) {
  if (runs.size() == 1) return lead(runs.front());
  return format("%zu estimates against one truth of %s. Differences are from the first one, %s.", runs.size(),
                length_text(runs.front().score.truth_motion.path_length_m).c_str(),
                runs.front().name.c_str());
}

std::vector<page::Tile> tiles_of(const Evaluation& e) {
  std::vector<page::Tile> tiles;
  const auto& rates = e.relative.overall;
  if (!e.relative.segments.empty()) {
    tiles.push_back({"Translation drift", number(rates.t_rel_percent), "%", "t_rel, KITTI's segments"});
    tiles.push_back(
        {"Rotation drift", number(rates.r_rel_deg_per_100m), "deg/100 m", "r_rel, KITTI's segments"});
  }
  tiles.push_back({"Absolute error", number(e.ate(Alignment::kSe3).rmse_m), "m", "ATE, SE(3)-aligned, rms"});
  if (std::isfinite(e.final_drift.percent))
    tiles.push_back(
        {"Off at the end", number(e.final_drift.percent), "%",
         number(e.final_drift.distance_m) + " m after " + length_text(e.truth_motion.path_length_m)});
  if (!e.relative.segments.empty())
    tiles.push_back({"Height drift", number(rates.axis_percent.z()), "%",
                     "roll " + number(rates.axis_deg_per_100m.x()) + ", pitch " +
                         number(rates.axis_deg_per_100m.y()) + " deg/100 m"});
  if (e.consistency && !e.consistency->motions.empty())
    tiles.push_back({"Covariance", number(std::sqrt(e.consistency->nees / 6.0)), "x",
                     "errors against what is reported; NEES " + number(e.consistency->nees)});
  return tiles;
}

std::string notices(const std::vector<ScoredRun>& runs) {
  std::string html;
  for (const ScoredRun& run : runs)
    for (const std::string& warning : run.score.warnings)
      html += page::notice(runs.size() == 1 ? "Note" : "Note on " + run.name, warning);
  return html;
}

std::string how_it_is_measured() {
  return page::details(
      "How these are measured",
      page::paragraph(
          "t_rel, r_rel: the KITTI devkit's segments of given lengths, from every tenth row; mean over all "
          "segments. Rows without an estimate are never closed up.") +
          page::paragraph(
              "ATE: distance between positions after a least-squares alignment without scale (Umeyama). "
              "SE(3) is evo's --align, yaw and position rpg's posyaw.") +
          page::paragraph(
              "rpg: from every row to the row closest to a part of the path. evo: pairs along the "
              "estimate's path, one after the other.") +
          page::paragraph(
              "Axes: x ahead, y left, z up, of the sensor. NEES: squared error of each motion by the "
              "reported covariance; 6 when it is right."));
}

}  // namespace

std::string evaluation_page(const EvaluationPage& content) {
  const std::vector<ScoredRun>& runs = content.scored;
  std::string html = notices(runs);
  html += runs.size() == 1 ? page::tiles(tiles_of(runs.front().score)) : comparison_table(runs);
  html += trajectory_section(runs) + course_section(runs) + segment_section(runs) + covariance_section(runs) +
          latency_section(content.timed) + ground_section(content.ground) + figures_section(runs) +
          how_it_is_measured();
  const std::string title = runs.size() == 1 ? "Trajectory of " + runs.front().name : "Trajectories compared";
  return page::document({title, lead(runs), html, content.made_by});
}

}  // namespace pago::report
