// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/run_files.hpp"

#include <fstream>

#include "output/records.hpp"
#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/output/run_recorder.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::output;
using Catch::Matchers::Contains;
using pago::test::record;
using pago::test::ScratchFolder;

SweepRecord with_covariance(std::uint64_t sequence) {
  SweepRecord r = record(sequence);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      r.covariance[6 * i + j] = 1e-4 / static_cast<double>(1 + i + j + sequence);
  return r;
}

/// The files of a run of five sweeps, the last one without a pose.
void write_run(const std::filesystem::path& folder) {
  RunRecorder recorder(folder, OutputConfig{});
  for (std::uint64_t i = 0; i < 4; ++i) recorder.add(with_covariance(i));
  SweepRecord partial = record(4);
  partial.has_pose = false;
  partial.times[3] = {};
  recorder.add(partial);
  RunReport report;
  report.version = "0.1.0";
  report.source = "drive.pcap";
  report.config_toml = "[odometry]\npose_instant = \"end\"\n";
  report.facts = {{"sensor", "HDL-64E S2"}, {"thread", "a"}, {"thread", "b"}};
  report.packets = PacketCounters{};
  report.packets->received = 10;
  report.sweeps.posed = 4;
  report.sweeps.partial = 1;
  report.sweeps.dropped = {2, 1};
  report.wall_s = 1.5;
  recorder.finish(report);
}

TEST_CASE("what a run wrote is read back", "[output][run_files]") {
  const ScratchFolder scratch;
  write_run(scratch.path);
  const RunFiles run = read_run_files(scratch.path);
  CHECK(run.facts.version == "0.1.0");
  CHECK(run.facts.source == "drive.pcap");
  CHECK(run.facts.wall_s == 1.5);
  CHECK(run.facts.poses == 4);
  CHECK(run.facts.length_m == Approx(3.0));
  CHECK(run.facts.hash.size() == 16);
  CHECK(run.facts.config_toml == "[odometry]\npose_instant = \"end\"\n");
  CHECK(run.facts.facts.size() == 3);
  CHECK(run.facts.facts[2] == std::pair<std::string, std::string>{"thread", "b"});
  CHECK(run.facts.dropped_sweeps() == 3);
  CHECK(run.facts.packets.front() == std::pair<std::string, std::uint64_t>{"received", 10});
  CHECK(run.facts.firings.empty());
}

TEST_CASE("latency rows are those of the sweeps, to the last written digit", "[output][run_files]") {
  const ScratchFolder scratch;
  write_run(scratch.path);
  const auto rows = read_run_files(scratch.path).latency;
  REQUIRE(rows.size() == 5);
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto splits = split_times(record(i));
    CHECK(rows[i].sequence == i);
    CHECK(rows[i].stamp_ns == record(i).stamp_ns);
    for (std::size_t s = 0; s < kNumStages; ++s) {
      CHECK(rows[i].stages[s].ran == splits[s].ran);
      CHECK(std::abs(rows[i].stages[s].run_ns - splits[s].run_ns) <= 100);
      CHECK(std::abs(rows[i].stages[s].wait_ns - splits[s].wait_ns) <= 100);
      CHECK(std::abs(rows[i].stages[s].cpu_ns - splits[s].cpu_ns) <= 100);
    }
    CHECK(rows[i].first_pose_ns == first_pose_ns(record(i)));
    CHECK(rows[i].refined_pose_ns < 0);
  }
  CHECK(rows[4].first_pose_ns < 0);
  CHECK_FALSE(rows[4].stages[3].ran);
}

TEST_CASE("poses.csv has a row per pose with its covariance", "[output][run_files]") {
  const ScratchFolder scratch;
  write_run(scratch.path);
  const auto poses = read_run_files(scratch.path).poses;
  REQUIRE(poses.size() == 4);
  for (std::uint64_t i = 0; i < 4; ++i) {
    CHECK(poses[i].sequence == i);
    CHECK(poses[i].health == (i == 0 ? "INIT" : "OK"));
    for (Eigen::Index row = 0; row < 6; ++row)
      for (Eigen::Index column = 0; column < 6; ++column)
        CHECK(
            poses[i].covariance(row, column) ==
            Approx(with_covariance(i).covariance[static_cast<std::size_t>(6 * row + column)]).epsilon(1e-9));
  }
}

TEST_CASE("a run that was cut off is read as far as it came", "[output][run_files]") {
  const ScratchFolder scratch;
  write_run(scratch.path);
  std::filesystem::remove(scratch.path / "run.json");
  std::filesystem::remove(scratch.path / "poses.csv");
  const std::string whole = test::contents(scratch.path / "latency.csv");
  std::ofstream(scratch.path / "latency.csv") << whole.substr(0, whole.size() - 10);
  const RunFiles run = read_run_files(scratch.path);
  CHECK(run.facts.version.empty());
  CHECK(run.latency.size() == 4);
  CHECK(run.poses.empty());
}

TEST_CASE("folders and files that are none of a run's are refused by name", "[output][run_files]") {
  const ScratchFolder scratch;
  CHECK_FALSE(is_results_folder(scratch.path));
  CHECK_THROWS_WITH(read_run_files(scratch.path), Contains("is not the results folder of a run"));
  std::ofstream(scratch.path / "run.json") << "{\"version\": ";
  CHECK_THROWS_WITH(read_run_files(scratch.path), Contains("run.json: is not JSON"));
  std::ofstream(scratch.path / "run.json") << "{\"version\": 3}";
  CHECK_THROWS_WITH(read_run_files(scratch.path), Contains("is not the run.json of a run"));
  std::ofstream(scratch.path / "latency.csv") << "a,b\n1,2\n";
  CHECK_THROWS_WITH(read_latency_csv(scratch.path / "latency.csv"), Contains("no column \"sequence\""));
}

}  // namespace
