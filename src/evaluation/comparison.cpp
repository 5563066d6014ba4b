// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "no_value.hpp"
#include "pago/core/text.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

struct Figure {
  const char *name, *unit, *meaning;
  double (*of)(const Evaluation&);
};

constexpr Figure kComparedFigures[] = {
    {"t_rel", "%", "translation error of KITTI's segments, of their length",
     [](const Evaluation& e) { return e.relative.overall.t_rel_percent; }},
    {"r_rel", "deg/100 m", "rotation error of KITTI's segments",
     [](const Evaluation& e) { return e.relative.overall.r_rel_deg_per_100m; }},
    {"ATE", "m", "root mean square distance between positions, SE(3)-aligned",
     [](const Evaluation& e) { return e.ate(Alignment::kSe3).rmse_m; }},
    {"ATE, yaw", "m", "the same, aligned in position and yaw only: tilt counts",
     [](const Evaluation& e) { return e.ate(Alignment::kYaw).rmse_m; }},
    {"end", "% of the path", "how far off the last pose is when both start together",
     [](const Evaluation& e) { return e.final_drift.percent; }},
    {"x", "%", "drift along the track",
     [](const Evaluation& e) { return e.relative.overall.axis_percent.x(); }},
    {"y", "%", "drift to the side", [](const Evaluation& e) { return e.relative.overall.axis_percent.y(); }},
    {"z", "%", "drift in height", [](const Evaluation& e) { return e.relative.overall.axis_percent.z(); }},
    {"roll", "deg/100 m", "drift in roll",
     [](const Evaluation& e) { return e.relative.overall.axis_deg_per_100m.x(); }},
    {"pitch", "deg/100 m", "drift in pitch",
     [](const Evaluation& e) { return e.relative.overall.axis_deg_per_100m.y(); }},
    {"yaw", "deg/100 m", "drift in yaw",
     [](const Evaluation& e) { return e.relative.overall.axis_deg_per_100m.z(); }},
    {"RPE", "m", "evo's relative pose error, root mean square of the translation",
     [](const Evaluation& e) { return e.pairs.translation_m.rmse; }},
    {"NEES", "6 if right", "squared error of each motion by the covariance reported with it",
     [](const Evaluation& e) { return e.consistency ? e.consistency->nees : kNoValue; }},
};

std::string cell(const ComparedFigure& figure, std::size_t i) {
  const bool is_there = std::isfinite(figure.values[i]);
  std::string text = is_there ? format("%10.4f", figure.values[i]) : format("%10s", "-");
  if (i > 0 && std::isfinite(figure.difference(i))) text += format(" (%+.4f)", figure.difference(i));
  return format("%-22s", text.c_str());
}

}  // namespace

std::vector<ComparedFigure> compared_figures(const std::vector<Evaluation>& evaluations) {
  std::vector<ComparedFigure> compared;
  for (const Figure& figure : kComparedFigures) {
    ComparedFigure row{figure.name, figure.unit, figure.meaning, {}};
    for (const Evaluation& e : evaluations) row.values.push_back(figure.of(e));
    if (std::any_of(row.values.begin(), row.values.end(), [](double value) { return std::isfinite(value); }))
      compared.push_back(std::move(row));
  }
  return compared;
}

std::string comparison_report(const std::vector<Evaluation>& evaluations) {
  std::string text, head = format("%-24s", "");
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    text += (i == 0 ? "truth     " + evaluations[i].truth_name + "\n" : std::string()) +
            format("estimate  %zu: ", i + 1) + evaluations[i].estimate_name +
            format(" (%zu of %zu rows, ", evaluations[i].num_matched, evaluations[i].num_rows) +
            evaluations[i].how + ")\n";
    head += format("%10s%12s", format("(%zu)", i + 1).c_str(), "");
  }
  text += head + "\n";
  for (const ComparedFigure& figure : compared_figures(evaluations)) {
    text += format("%-24s", (figure.name + ", " + figure.unit).c_str());
    for (std::size_t i = 0; i < evaluations.size(); ++i) text += cell(figure, i);
    text += "\n";
  }
  for (std::size_t i = 0; i < evaluations.size(); ++i)
    for (const std::string& warning : evaluations[i].warnings)
      text += format("note on %zu: ", i + 1) + warning + "\n";
  return text;
}

}  // namespace pago::evaluation
