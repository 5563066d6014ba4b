// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/evaluation_page.hpp"

#include "evaluation/paths.hpp"
#include "page/markup.hpp"
#include "pago/page/html.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::report;
using namespace pago::test;
using Catch::Matchers::Contains;
using evaluation::GroundComparison;
using evaluation::GroundProtocol;

ScoredRun run_of(const std::string& name, double scale) {
  const evaluation::Trajectory truth = town_drive(400, "truth.txt");
  evaluation::Trajectory estimate = truth;
  for (auto& pose : estimate.poses) pose.T_world_sensor.translation() *= scale;
  Matrix6d covariance = Matrix6d::Identity() * 1e-4;
  estimate.motion_covariances.assign(estimate.poses.size(), covariance);
  evaluation::EvaluationOptions options;
  options.segments.lengths_m = {50, 100};
  return {name, evaluate(truth, estimate, options)};
}

GroundComparison ground(GroundProtocol protocol) {
  return {.protocol = protocol,
          .frames = {3, 7},
          .methods = {{"<moss>", {{protocol, 90, 10, 0, 5, 0}, {protocol, 80, 0, 20, 5, 0}}}}};
}

EvaluationPage page_of(std::vector<ScoredRun> runs) {
  EvaluationPage page;
  for (const ScoredRun& run : runs) page.timed.push_back({run.name, {}});
  page.scored = std::move(runs);
  page.made_by = "pago evaluate";
  return page;
}

TEST_CASE("one run: what matters first, then every figure", "[report][page]") {
  const ScoredRun run = run_of("pago", 1.01);
  const std::string html = evaluation_page(page_of({run}));
  CHECK(misplaced_tag(html) == "");
  CHECK_FALSE(fetches(html));
  const auto& overall = run.score.relative.overall;
  CHECK_THAT(html, Contains("Translation drift<b>" + page::number(overall.t_rel_percent) + "<span>%</span>"));
  CHECK_THAT(html, Contains("Rotation drift<b>" + page::number(overall.r_rel_deg_per_100m) +
                            "<span>deg/100 m</span>"));
  for (const char* title :
       {"<h3>Plan</h3>", "<h3>Height</h3>", "<h3>Position error</h3>", "<h3>Translation by length</h3>",
        "<h3>Translation by speed</h3>", "<h3>Drift in roll</h3>", "Does it know how good it is?",
        "<h3>Absolute error (ATE; evo's APE)</h3>", "rpg"})
    CHECK_THAT(html, Contains(title));
  CHECK(html == evaluation_page(page_of({run})));
}

TEST_CASE("rotation is in degrees per hundred metres everywhere", "[report][page]") {
  const std::string html = evaluation_page(page_of({run_of("a", 1.0), run_of("b", 1.01)}));
  CHECK(times(html, "deg/100 m") > 5);
  CHECK(times(html, "deg/m") == 0);
}

TEST_CASE("several runs lie over each other and are compared with the first", "[report][page]") {
  const std::string html = evaluation_page(page_of({run_of("good & old", 1.001), run_of("bad", 1.01)}));
  CHECK(misplaced_tag(html) == "");
  CHECK_THAT(html, Contains("good &amp; old") && !Contains("good & old"));
  CHECK_THAT(html, Contains("class=\"best\"") && Contains("class=\"bad\">+"));
  // Plan: two runs and the truth.
  const std::string plan =
      html.substr(html.find("<h3>Plan</h3>"), html.find("<h3>Height</h3>") - html.find("<h3>Plan</h3>"));
  CHECK(times(plan, "<polyline") == 3);
  CHECK(times(plan, "class=\"line cn\"") == 1);
}

TEST_CASE("a path shorter than every length has a page without drift", "[report][page]") {
  const evaluation::Trajectory truth = town_drive(50, "truth.txt");
  const std::string html = evaluation_page(page_of({{"short", evaluate(truth, truth)}}));
  CHECK(misplaced_tag(html) == "");
  CHECK_THAT(html, !Contains("Translation drift") && !Contains("nan") && Contains("<h3>Plan</h3>"));
}

TEST_CASE("warnings stand at the top", "[report][page]") {
  ScoredRun run = run_of("pago", 1.0);
  run.score.warnings = {"The estimate seems to hold <camera> poses."};
  const std::string html = evaluation_page(page_of({run}));
  CHECK_THAT(html, Contains("The estimate seems to hold &lt;camera&gt; poses."));
  CHECK(html.find("class=\"notice\"") < html.find("class=\"tiles\""));
}

TEST_CASE("ground has a block per protocol, never one table", "[report][ground]") {
  const std::vector both{ground(GroundProtocol::kPatchwork), ground(GroundProtocol::kPatchworkPlusPlus)};
  const std::string html = ground_page("sweeps & scans", both, "pago segment");
  CHECK(misplaced_tag(html) == "");
  CHECK_FALSE(fetches(html));
  CHECK_THAT(html, Contains("<h1>sweeps &amp; scans</h1>") && !Contains("<moss>"));
  CHECK(times(html, "<table>") == 2);
  CHECK(times(html, "protocol A (Patchwork)</h2>") == 1);
  CHECK(times(html, "protocol B (Patchwork++)</h2>") == 1);
  CHECK(times(html, "Precision over the drive</h3>") == 2);
  CHECK(times(html, "Recall over the drive</h3>") == 2);
  CHECK_THAT(html, Contains("<td>95.00<small>± 5.00</small></td><td>90.00<small>± 10.00</small></td>"));
  EvaluationPage page = page_of({run_of("pago", 1.0)});
  page.ground = both;
  CHECK(times(evaluation_page(page), "<h2>Ground against the labels") == 2);
}

TEST_CASE("a ground score that is not defined is n/a, and no dot", "[report][ground]") {
  GroundComparison none = ground(GroundProtocol::kPatchwork);
  none.methods[0] = {"none", {{none.protocol, 0, 0, 90, 5, 0}, {none.protocol, 0, 0, 0, 5, 0}}};
  const std::string html = ground_page("", std::vector{none}, "pago segment");
  CHECK(misplaced_tag(html) == "");
  CHECK_THAT(html, Contains("<td>n/a<small>± n/a</small></td><td>0.00<small>± 0.00</small></td>"));
  CHECK_THAT(html, Contains("1 frames, and 1 without ground"));
  CHECK(times(html, "nan") == 0);
}

}  // namespace
