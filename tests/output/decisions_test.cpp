// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/decisions.hpp"

#include <fstream>

#include "output/records.hpp"
#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/output/run_report.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::output;
using Numbers = std::vector<std::uint64_t>;

namespace {

SweepRecord swept(std::uint64_t sequence, std::uint64_t request, std::uint32_t flags = 0) {
  SweepRecord record = test::record(sequence);
  record.header.request = request;
  record.header.flags = flags;
  return record;
}

DecisionLog example() {
  DecisionLog log;
  log.add(swept(0, 1));
  log.add(swept(1, 2, kSuperseded));
  log.add(swept(2, 4));  // request 3 was not met
  log.add(swept(5, 7, kAfterReset | kSuperseded));
  log.close(9);
  return log;
}

}  // namespace

TEST_CASE("what the clock decided is read off the sweeps", "[output][decisions]") {
  const DecisionLog log = example();
  const Decisions& d = log.decisions();
  CHECK(d.superseded == Numbers{1, 5});
  CHECK(d.unmet == Numbers{3, 5, 6, 8, 9});
  CHECK(d.resets == Numbers{5});
  CHECK_FALSE(d.empty());
  CHECK(DecisionLog().decisions().empty());
}

TEST_CASE("decisions are written to run.json and read back", "[output][decisions]") {
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "run.json";
  RunReport report;
  report.requests = 9;
  std::ofstream(file) << run_json(report, {}, example());
  const Decisions read = read_decisions(file);
  CHECK(read.superseded == example().decisions().superseded);
  CHECK(read.unmet == example().decisions().unmet);
  CHECK(read.resets == example().decisions().resets);
}

TEST_CASE("a run that goes on, or whose files miss sweeps, cannot be repeated", "[output][decisions]") {
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "run.json";
  RunReport report;
  std::ofstream(file) << run_json(report, {}, example());
  CHECK_THROWS_WITH(read_decisions(file), Catch::Contains("saved before its end"));
  report.requests = 9;
  report.unrecorded = 1;
  std::ofstream(file) << run_json(report, {}, example());
  CHECK_THROWS_WITH(read_decisions(file), Catch::Contains("miss sweeps"));
}

TEST_CASE("a log with too many decisions says so, and is refused", "[output][decisions]") {
  DecisionLog log;
  log.add(swept(0, 1'000'002));
  CHECK_FALSE(log.is_complete());
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "run.json";
  std::ofstream(file) << run_json({}, {}, log);
  CHECK_THROWS_WITH(read_decisions(file), Catch::Contains("does not know all"));
}

TEST_CASE("what is no run.json is refused in words", "[output][decisions]") {
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "run.json";
  CHECK_THROWS_WITH(read_decisions(file), Catch::Contains("cannot be opened"));
  for (const char* text :
       {"", "poses", "[]", "{}", R"({"decisions": 3})", R"({"decisions": {"complete": true}})"}) {
    std::ofstream(file) << text;
    INFO(text);
    CHECK_THROWS_AS(read_decisions(file), Error);
  }
}
