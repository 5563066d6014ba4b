// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/latency.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "output/records.hpp"
#include "output/scratch_folder.hpp"
#include "pago/output/trace.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::output;
using pago::test::record;

constexpr std::int64_t kMs = 1'000'000;

TEST_CASE("a sweep's time is split into waiting, running and computing per stage", "[output][latency]") {
  const auto splits = split_times(record(3));
  CHECK(splits[0].wait_ns == 0);
  CHECK(splits[1].wait_ns == 1 * kMs);
  CHECK(splits[1].run_ns == 3 * kMs);
  CHECK(splits[2].wait_ns == 0);
  CHECK(splits[3].wait_ns == 2 * kMs);
  CHECK(splits[3].run_ns == 5 * kMs);
  CHECK(splits[3].cpu_ns == 5 * kMs);
  CHECK_FALSE(splits[4].ran);
  CHECK(first_pose_ns(record(3)) == 15 * kMs);
  CHECK(refined_pose_ns(record(3)) < 0);
}

TEST_CASE("stages that did not run are skipped, overlapping ones do not wait", "[output][latency]") {
  SweepRecord r = record(0);
  r.times[2] = {};
  CHECK(split_times(r)[3].wait_ns == 6 * kMs);  // since the end of ground
  r.times[1].start_ns = 50 * kMs;               // began while the sweep was still filling
  CHECK(split_times(r)[1].wait_ns == 0);
  CHECK(split_times(r)[1].run_ns == 54 * kMs);
}

TEST_CASE("only sweeps with a pose have a time to it", "[output][latency]") {
  SweepRecord r = record(0);
  r.has_pose = false;
  CHECK(first_pose_ns(r) < 0);
  LatencyReport report;
  report.add(r);
  CHECK(report.first_pose.count() == 0);
  CHECK(report.stages[3].run.count() == 1);
  CHECK(report.stages[4].run.count() == 0);
}

TEST_CASE("latency.csv has a row per sweep and a cell per column", "[output][latency]") {
  const pago::test::ScratchFolder scratch;
  LatencyCsv csv(scratch.path / "latency.csv");
  for (std::uint64_t i = 0; i < 5; ++i) csv.write(record(i));
  csv.flush();
  std::istringstream lines(pago::test::contents(scratch.path / "latency.csv"));
  std::string header, first, line;
  std::getline(lines, header);
  std::getline(lines, first);
  CHECK(header.substr(0, 60) == "sequence,stamp_ns,ingest_wait_ms,ingest_run_ms,ingest_cpu_ms");
  CHECK(first ==
        "0,1317378034000000000,0.0000,100.0000,2.0000,1.0000,3.0000,3.0000,0.0000,4.0000,4.0000,"
        "2.0000,5.0000,5.0000,,,,,,,15.0000,");
  int rows = 1;
  for (; std::getline(lines, line); ++rows)
    CHECK(std::count(line.begin(), line.end(), ',') == std::count(header.begin(), header.end(), ','));
  CHECK(rows == 5);
}

nlohmann::json events_of(const Trace& trace, const char* phase) {
  nlohmann::json events = nlohmann::json::array();
  const auto trace_json = nlohmann::json::parse(trace.json());
  for (const auto& event : trace_json.at("traceEvents"))
    if (event.at("ph") == phase) events.push_back(event);
  return events;
}

TEST_CASE("the trace has a bar per stage and sweep on its thread's row", "[output][trace]") {
  Trace trace(10);
  trace.add(record(0));
  trace.add(record(1));
  const auto bars = events_of(trace, "X");
  REQUIRE(bars.size() == 8);
  CHECK(bars[7]["name"] == "odometry");
  CHECK(bars[7]["ts"] == 210'000.0);
  CHECK(bars[7]["dur"] == 5'000.0);
  CHECK(bars[7]["args"]["sweep"] == 1);
  CHECK(bars[1]["tid"] == bars[2]["tid"]);  // ground and features share the front thread
  CHECK(bars[0]["tid"] != bars[1]["tid"]);
  CHECK(bars[3]["tid"] != bars[1]["tid"]);
  const auto names = events_of(trace, "M");
  REQUIRE(names.size() == 4);
  CHECK(names[1]["args"]["name"] == "front");
  CHECK(names[1]["tid"] == bars[1]["tid"]);
}

TEST_CASE("the trace keeps the last sweeps in order", "[output][trace]") {
  Trace trace(3);
  for (std::uint64_t i = 0; i < 8; ++i) trace.add(record(i));
  const auto bars = events_of(trace, "X");
  REQUIRE(bars.size() == 12);
  for (std::size_t i = 0; i < 3; ++i) CHECK(bars[4 * i]["args"]["sweep"] == 5 + i);
}

TEST_CASE("no trace is kept when none is asked for", "[output][trace]") {
  Trace trace(0);
  trace.add(record(0));
  CHECK(trace.size() == 0);
  CHECK(events_of(trace, "X").empty());
}

}  // namespace
