// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/latency.hpp"

#include <cmath>

#include "page/markup.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::report;
using namespace pago::test;
using Catch::Matchers::Contains;

/// Ground and odometry run for 2 and 8 ms; every tenth sweep is a partial one that has no pose.
TimedRun run_of(const std::string& name, int sweeps) {
  TimedRun run{name, {}};
  for (int i = 0; i < sweeps; ++i) {
    output::LatencyRow row;
    row.sequence = static_cast<std::uint64_t>(i);
    for (const auto& [stage, ms] : {std::pair{StageId::kGround, 2}, std::pair{StageId::kOdometry, 8}}) {
      output::StageSplit& split = row.stages[static_cast<std::size_t>(stage)];
      split.ran = true;
      split.cpu_ns = ms * 1'000'000;
    }
    if (i % 10 != 9) row.first_pose_ns = 12'000'000 + i * 10'000;
    run.files.latency.push_back(row);
  }
  return run;
}

const LatencySeries& find(const std::vector<LatencySeries>& all, const std::string& name) {
  for (const LatencySeries& series : all)
    if (series.name == name) return series;
  throw std::runtime_error(name);
}

TEST_CASE("stages that ran are listed, and sweeps without a pose have no time to it", "[report][latency]") {
  const auto all = latency_series(run_of("", 100).files.latency);
  CHECK(all.size() == 4);
  CHECK(find(all, "ground").is_cpu);
  CHECK(find(all, "ground").ms == std::vector<double>(100, 2.0));
  CHECK(find(all, "all stages").ms == std::vector<double>(90, 10.0));
  CHECK_FALSE(find(all, "first pose").is_cpu);
  CHECK(find(all, "first pose").ms.size() == 90);
  CHECK(find(all, "first pose").sweeps[9] == 10.0);
}

TEST_CASE("percentiles are values that occurred", "[report][latency]") {
  std::vector<double> values;
  for (int i = 100; i > 0; --i) values.push_back(i);
  const Percentiles p = percentiles_of(values);
  CHECK(p.p50 == 50.0);
  CHECK(p.p99 == 99.0);
  CHECK(p.max == 100.0);
  CHECK(p.count == 100);
  CHECK(std::isnan(percentiles_of({}).p50));
}

TEST_CASE("a run without latencies keeps its colour to itself", "[report][latency]") {
  CHECK(latency_section({{"file.tum", {}}}).empty());
  const std::string html = latency_section({{"file.tum", {}}, run_of("pago", 20)});
  CHECK(misplaced_tag(html) == "");
  CHECK_THAT(html,
             !Contains("file.tum") && Contains("pago, ground: 2.000") && Contains("pago, odometry: 8.000"));
  CHECK(times(html, "data-series=\"c0\"") == 0);
  CHECK(times(html, "data-series=\"c1\"") >= 3);
}

}  // namespace
