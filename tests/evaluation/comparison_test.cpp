// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/paths.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;
using Catch::Matchers::Contains;

std::vector<Evaluation> two_runs() {
  const Trajectory truth = town_drive(400, "truth.txt");
  Trajectory good = truth, bad = truth;
  good.name = "good.txt";
  bad.name = "bad.txt";
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    good.poses[i].T_world_sensor.translation() *= 1.001;
    bad.poses[i].T_world_sensor.translation() *= 1.01;
  }
  EvaluationOptions options;
  options.segments.lengths_m = {50, 100};
  return {evaluate(truth, good, options), evaluate(truth, bad, options)};
}

TEST_CASE("runs are compared figure by figure with the first", "[evaluation][comparison]") {
  const auto runs = two_runs();
  const auto figures = compared_figures(runs);
  const auto t_rel =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f.name == "t_rel"; });
  REQUIRE(t_rel != figures.end());
  CHECK(t_rel->unit == "%");
  REQUIRE(t_rel->values.size() == 2);
  CHECK(t_rel->values[1] == runs[1].relative.overall.t_rel_percent);
  CHECK(t_rel->difference(1) == Approx(0.9).margin(0.1));  // bends are shorter than their paths
  for (const ComparedFigure& figure : figures)
    if (figure.name == "roll" || figure.name == "pitch" || figure.name == "yaw" || figure.name == "r_rel")
      CHECK(figure.unit == "deg/100 m");
}

TEST_CASE("the table names every run and shows each difference once", "[evaluation][comparison]") {
  const auto runs = two_runs();
  const std::string report = comparison_report(runs);
  CHECK_THAT(report, Contains("truth     truth.txt\n") &&
                         Contains("estimate  1: good.txt (400 of 400 rows") &&
                         Contains("estimate  2: bad.txt"));
  CHECK_THAT(report, Contains("t_rel, %") && Contains("r_rel, deg/100 m") && Contains("ATE, m"));
  CHECK(report.find("deg/m") == std::string::npos);
  CHECK_THAT(report, !Contains("nan"));
}

TEST_CASE("figures that no run has are left out, those that one lacks stay empty",
          "[evaluation][comparison]") {
  const Trajectory truth = chain(planar(1, 0, 0), 70, "truth");
  const std::vector<Evaluation> short_runs{evaluate(truth, truth), evaluate(truth, truth)};
  for (const ComparedFigure& figure : compared_figures(short_runs)) CHECK(figure.name != "t_rel");
  std::vector<Evaluation> mixed = two_runs();
  mixed[1].relative.overall = drift_rates({});
  CHECK_THAT(comparison_report(mixed), Contains("-") && !Contains("nan"));
  CHECK_THAT(comparison_report(mixed), Contains("note on") || !Contains("note"));
}

}  // namespace
