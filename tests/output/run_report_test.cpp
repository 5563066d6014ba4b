// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/run_report.hpp"

#include <nlohmann/json.hpp>

#include "output/records.hpp"
#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/output/run_recorder.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::output;
using Catch::Matchers::Contains;
using pago::test::contents;
using pago::test::record;
using pago::test::ScratchFolder;

RunReport report() {
  RunReport r;
  r.version = "0.1.0";
  r.source = "drive.pcap";
  r.config_toml = "[ground]\nmethod = \"patchwork\"\n";
  r.facts = {{"sensor", "HDL-64E S2"}, {"thread", "a"}, {"thread", "b"}, {"thread", "c"}};
  r.packets = PacketCounters{};
  r.packets->received = 10;
  r.packets->decoded = 6;
  r.packets->duplicate = 1;
  r.packets->bad[static_cast<std::size_t>(PacketFault::kSize)] = 2;
  r.packets->bad[static_cast<std::size_t>(PacketFault::kStamp)] = 1;
  r.firings = FiringCounters{.expected = 100, .decoded = 98, .lost = 2};
  r.sweeps.opened = 7;
  r.sweeps.posed = 3;
  r.sweeps.partial = 1;
  r.sweeps.dropped = {2, 1};
  r.wall_s = 1.5;
  r.is_live = true;
  return r;
}

RunTotals totals(std::uint64_t sweeps) {
  RunTotals t;
  for (std::uint64_t i = 0; i < sweeps; ++i) t.add(record(i));
  return t;
}

TEST_CASE("the way back to a reset's origin is no path, also when the reset's own sweep got no pose",
          "[output][run_report]") {
  RunTotals t = totals(4);
  SweepRecord reset = record(4);
  reset.has_pose = false;
  reset.header.flags = kAfterReset | kSuperseded;
  t.add(reset);
  for (std::uint64_t i = 0; i < 3; ++i) t.add(record(i));
  CHECK(t.length_m == Approx(3.0 + 2.0));
  CHECK(t.num_poses == 7);
  CHECK(t.superseded == 1);
  CHECK(t.partial == 0);
}

TEST_CASE("totals follow the poses", "[output][run_report]") {
  RunTotals t = totals(4);
  CHECK(t.num_poses == 4);
  CHECK(t.length_m == Approx(3.0));
  CHECK(t.first_stamp_ns == record(0).stamp_ns);
  CHECK(t.last_stamp_ns == record(3).stamp_ns);
  CHECK(t.health == std::array<std::uint64_t, 4>{1, 3, 0, 0});
  const std::string hash = t.hash.hex();
  SweepRecord without = record(9);
  without.has_pose = false;
  t.add(without);
  CHECK(t.num_poses == 4);
  CHECK(t.length_m == Approx(3.0));
  CHECK(t.hash.hex() == hash);
  CHECK(t.latency.stages[1].run.count() == 5);
}

TEST_CASE("the hash tells first and refined poses apart", "[output][run_report]") {
  RunTotals same, first, refined;
  SweepRecord r = record(1);
  same.add(r);
  r.T_odom_sensor_first[3] += 1e-15;
  first.add(r);
  r = record(1);
  r.T_odom_sensor_refined[3] += 1e-15;
  refined.add(r);
  CHECK(same.hash.hex() != first.hash.hex());
  CHECK(same.hash.hex() != refined.hash.hex());
  CHECK(first.hash.hex() != refined.hash.hex());
}

TEST_CASE("run.json has every count by its cause", "[output][run_report]") {
  const auto json = nlohmann::json::parse(run_json(report(), totals(3)));
  CHECK(json["version"] == "0.1.0");
  CHECK(json["source"] == "drive.pcap");
  CHECK(json["config"] == "[ground]\nmethod = \"patchwork\"\n");
  CHECK(json["facts"]["sensor"] == "HDL-64E S2");
  CHECK(json["facts"]["thread"] == std::vector<std::string>{"a", "b", "c"});
  CHECK(json["packets"]["received"] == 10);
  CHECK(json["packets"]["bad"]["size"] == 2);
  CHECK(json["packets"]["bad"]["stamp"] == 1);
  CHECK(json["packets"]["bad"]["azimuth"] == 0);
  CHECK(json["packets"]["balanced"] == true);
  CHECK(json["firings"]["lost"] == 2);
  CHECK(json["datagrams"].is_null());
  CHECK(json["sweeps"]["dropped"]["no free sweep"] == 2);
  CHECK(json["sweeps"]["dropped"]["superseded"] == 1);
  CHECK(json["sweeps"]["balanced"] == true);
  CHECK(json["trajectory"]["hash"] == totals(3).hash.hex());
  CHECK(json["trajectory"]["length_m"] == 2.0);
  CHECK(json["trajectory"]["health"]["OK"] == 2);
  CHECK(json["latency_ms"]["odometry"]["run"]["count"] == 3);
  CHECK(json["latency_ms"]["odometry"]["run"]["max"] == 5.0);
  CHECK(json["latency_ms"]["odometry"]["wait"]["max"] == 2.0);
  CHECK(json["latency_ms"]["first_pose"]["max"] == 15.0);
  CHECK_FALSE(json["latency_ms"].contains("mapping"));
}

TEST_CASE("the summary is short and says what was lost and where things are", "[output][run_report]") {
  const std::string text = run_summary(report(), totals(3), "results/now");
  CHECK_THAT(text, Contains("3 with a pose, 1 partial, 3 dropped (2 no free sweep, 1 superseded)\n"));
  CHECK_THAT(text, Contains("6 decoded of 10, 1 duplicate, 0 late, 3 bad (2 size, 1 stamp)\n"));
  CHECK_THAT(text, Contains("2 of 100 lost"));
  CHECK_THAT(text, Contains("2.00 m in 3 poses, hash " + totals(3).hash.hex()));
  CHECK_THAT(text, Contains("INIT 1, OK 2"));
  CHECK_THAT(text,
             Contains("odometry") && Contains("first pose") && !Contains("mapping") && !Contains("refined"));
  CHECK_THAT(text, Contains("results/now\n") && !Contains("NOT BALANCED") && !Contains("problem"));
  CHECK(std::count(text.begin(), text.end(), '\n') < 20);
}

TEST_CASE("a replay's summary has the stages' own time, and no waits", "[output][run_report]") {
  RunReport r = report();
  r.is_live = false;
  const std::string text = run_summary(r, totals(3), "x");
  CHECK_THAT(text,
             Contains("odometry") && Contains("cpu p50") && !Contains("wall") && !Contains("first pose"));
}

TEST_CASE("counts that do not add up are shouted", "[output][run_report]") {
  RunReport r = report();
  ++r.sweeps.opened;
  CHECK_THAT(run_summary(r, totals(3), "x"), Contains("NOT BALANCED"));
  CHECK(nlohmann::json::parse(run_json(r, totals(3)))["sweeps"]["balanced"] == false);
}

TEST_CASE("an early end is told", "[output][run_report]") {
  RunReport r = report();
  r.complaint = "capture ends inside a record";
  CHECK_THAT(run_summary(r, totals(3), "x"), Contains("problem   capture ends inside a record\n"));
  CHECK(nlohmann::json::parse(run_json(r, totals(3)))["complaint"] == "capture ends inside a record");
}

TEST_CASE("a run without packets and without poses has a summary too", "[output][run_report]") {
  const std::string text = run_summary(RunReport{}, RunTotals{}, "x");
  CHECK_THAT(text, !Contains("packets") && Contains("0.00 m in 0 poses"));
  CHECK(nlohmann::json::parse(run_json(RunReport{}, RunTotals{}))["packets"].is_null());
}

TEST_CASE("a recorded run leaves all its files, one pose per sweep that has one", "[output][run_recorder]") {
  const ScratchFolder scratch;
  RunRecorder recorder(scratch.path, OutputConfig{});
  for (std::uint64_t i = 0; i < 10; ++i) {
    SweepRecord r = record(i);
    r.has_pose = i != 0;  // a partial first sweep
    r.T_odom_sensor_refined[7] = 0.5;
    recorder.add(r);
  }
  recorder.finish(report());
  CHECK(recorder.complaints().empty());
  for (const char* name : {"odometry.tum", "odometry.kitti", "trajectory.tum", "trajectory.kitti"})
    CHECK(evaluation::read_trajectory(scratch.path / name).poses.size() == 9);
  const auto first = evaluation::read_trajectory(scratch.path / "odometry.tum");
  const auto refined = evaluation::read_trajectory(scratch.path / "trajectory.tum");
  CHECK(first.poses[0].T_world_sensor.translation() == Eigen::Vector3d(1, 0, 0));
  CHECK(refined.poses[0].T_world_sensor.translation() == Eigen::Vector3d(1, 0.5, 0));
  const std::string csv = contents(scratch.path / "latency.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 11);
  CHECK(nlohmann::json::parse(contents(scratch.path / "run.json"))["trajectory"]["poses"] == 9);
  CHECK(nlohmann::json::parse(contents(scratch.path / "trace.json")).contains("traceEvents"));
}

TEST_CASE("two recordings of the same sweeps are the same bytes", "[output][run_recorder]") {
  const ScratchFolder a, b;
  for (const ScratchFolder* scratch : {&a, &b}) {
    RunRecorder recorder(scratch->path, OutputConfig{});
    for (std::uint64_t i = 0; i < 10; ++i) recorder.add(record(i));
    recorder.finish(report());
  }
  for (const char* name : {"odometry.tum", "odometry.kitti", "trajectory.kitti", "run.json", "latency.csv"})
    CHECK(contents(a.path / name) == contents(b.path / name));
}

TEST_CASE("with an interval of 0 each pose is on the disk at once", "[output][run_recorder]") {
  const ScratchFolder scratch;
  OutputConfig config;
  config.flush_interval_s = 0.0;
  RunRecorder recorder(scratch.path, config);
  recorder.add(record(0));
  CHECK(evaluation::read_trajectory(scratch.path / "trajectory.tum").poses.size() == 1);
}

TEST_CASE("a full disk leaves complaints and the other files", "[output][run_recorder]") {
  const ScratchFolder scratch;
  // A report is written beside its place first.
  for (const char* name : {"odometry.tum", "latency.csv", "run.json.new"})
    std::filesystem::create_symlink("/dev/full", scratch.path / name);
  RunRecorder recorder(scratch.path, OutputConfig{});
  for (std::uint64_t i = 0; i < 10; ++i) recorder.add(record(i));
  recorder.finish(report());
  const auto complaints = recorder.complaints();
  REQUIRE(complaints.size() == 3);
  CHECK_THAT(complaints[0], Contains("odometry.tum: cannot be written"));
  CHECK_THAT(complaints[2], Contains("run.json.new: cannot be written"));
  CHECK(evaluation::read_trajectory(scratch.path / "trajectory.tum").poses.size() == 10);
}

TEST_CASE("a recorder without its folder is refused", "[output][run_recorder]") {
  CHECK_THROWS_AS(RunRecorder("no/such/folder", OutputConfig{}), Error);
}

}  // namespace
