// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/program.hpp"
#include "pago/udp/udp_source.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

namespace {

/// A port that nothing listens on.
int free_port() {
  return UdpSource({"127.0.0.1", 0}).port();
}

/// A pago that reads a live sensor on a port of its own.
struct LiveRun {
  explicit LiveRun(const std::vector<std::string>& more = {})
      : port(free_port()), program(folder.path(), words(more)) {
    program.wait_for("ctl");
  }

  std::vector<std::string> words(const std::vector<std::string>& more) const {
    std::vector<std::string> result{
        "run",           "udp://127.0.0.1:" + std::to_string(port),
        "--calibration", "calibration.yaml",
        "--set",         "control.socket=ctl",
        "--set",         "publish.shared_memory=pago_test_" + std::to_string(port),
        "--set",         "publish.json_lines=poses.jsonl"};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  Outcome play() const {
    return run_pago(folder.path(), "play street.pcap --speed 0.5 --to 127.0.0.1:" + std::to_string(port));
  }

  nlohmann::json ctl(const std::string& request) {
    const Outcome outcome = run_pago(folder.path(), "ctl " + request + " --socket ctl");
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return nlohmann::json::parse(outcome.out);
  }
  /// Until the status says so, or it clearly never will.
  bool comes_to(const std::string& key, const nlohmann::json& value) {
    for (int i = 0; i < 200; ++i) {
      if (ctl("status")[key] == value) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  std::string log() const { return read_text(folder.path() / "results/latest/log.txt"); }

  StreetFolder folder;
  int port;
  RunningProgram program;
};

}  // namespace

TEST_CASE("started before its sensor, a live run waits, says so, and goes on when it comes", "[app][live]") {
  LiveRun live;
  CHECK(live.ctl("status")["state"] == "no data");
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  const Outcome played = live.play();
  INFO(played.out << played.err);
  REQUIRE(played.exit_code == 0);
  CHECK(played.out.find("% of a core") != std::string::npos);
  CHECK(live.comes_to("state", "silent"));
  const nlohmann::json status = live.ctl("status");
  CHECK(status["poses"].get<int>() >= 2);
  CHECK(status["packets"]["decoded"] == live.folder.num_packets());

  const std::string saved = live.ctl("save")["folder"];
  const auto so_far = nlohmann::json::parse(read_text(live.folder.path() / saved / "run.json"));
  CHECK(so_far["sweeps"]["posed"] == so_far["trajectory"]["poses"]);
  CHECK(so_far["sweeps"]["balanced"] == true);
  CHECK(so_far["decisions"]["complete"] == false);
  CHECK(fs::exists(live.folder.path() / live.ctl("trace")["trace"].get<std::string>()));
  live.ctl("reset");

  CHECK(live.program.interrupt() == 0);
  CHECK(live.log().find("no data on udp://127.0.0.1") != std::string::npos);
  CHECK(live.log().find("HDL-64E") != std::string::npos);
  CHECK(live.log().find("has fallen silent") != std::string::npos);
  CHECK(live.log().find("reset") != std::string::npos);
  const auto report = nlohmann::json::parse(read_text(live.folder.path() / "results/latest/run.json"));
  CHECK(report["packets"]["decoded"] == live.folder.num_packets());
  CHECK(report["sweeps"]["balanced"] == true);
  CHECK(report["datagrams"]["balanced"] == true);
  const std::string lines = read_text(live.folder.path() / "poses.jsonl");
  // One for each pose; and when the sensor had fallen silent, the last one again, as lost.
  CHECK(std::count(lines.begin(), lines.end(), '\n') == report["trajectory"]["poses"].get<int>() + 1);
  CHECK(lines.find("\"no data\"") != std::string::npos);
}

TEST_CASE("the recorded packets of a live run, replayed, give its trajectory to the byte",
          "[app][live][record]") {
  LiveRun live({"--record", "live.pcap"});
  REQUIRE(live.play().exit_code == 0);
  CHECK(live.comes_to("state", "silent"));
  CHECK(live.program.interrupt() == 0);
  const fs::path results = live.folder.path() / "results/latest";
  const auto report = nlohmann::json::parse(read_text(results / "run.json"));
  const std::string recorded =
      std::to_string(live.folder.num_packets()) + " datagrams in live.pcap, 0 not written";
  CHECK(report["facts"]["recorded"] == recorded);

  // On a busy machine it may have dropped sweeps; then that is repeated too.
  const Outcome replay =
      run_pago(live.folder.path(),
               "run live.pcap --calibration calibration.yaml --as-recorded results/latest/run.json "
               "--output again --set packets.port=" +
                   std::to_string(live.port));
  INFO(replay.err);
  REQUIRE(replay.exit_code == 0);
  for (const char* name : {"odometry.tum", "odometry.kitti", "trajectory.tum", "trajectory.kitti"}) {
    CAPTURE(name);
    CHECK_FALSE(read_text(results / name).empty());
    CHECK(read_text(live.folder.path() / "again/latest" / name) == read_text(results / name));
  }
}

TEST_CASE("pago record keeps what a sensor sends, and nothing is changed by it", "[app][live][record]") {
  const StreetFolder folder;
  const int port = free_port();
  const std::string address = "127.0.0.1:" + std::to_string(port);
  fs::create_directories(folder.path() / "kept");
  RunningProgram recorder(folder.path(), {"record", "udp://" + address, "-o", "kept/street.pcap"});
  recorder.wait_for("kept/street.pcap");
  REQUIRE(run_pago(folder.path(), "play street.pcap --to " + address).exit_code == 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(recorder.interrupt() == 0);
  const std::string said = read_text(folder.path() / "out.txt");
  INFO(said);
  CHECK(said.find(std::to_string(folder.num_packets()) + " datagrams") != std::string::npos);

  REQUIRE(run_pago(folder.path(), "run street.pcap").exit_code == 0);
  REQUIRE(run_pago(folder.path(),
                   "run kept/street.pcap --calibration calibration.yaml --output again --set "
                   "packets.port=" +
                       std::to_string(port))
              .exit_code == 0);
  CHECK(read_text(folder.path() / "again/latest/odometry.kitti") ==
        read_text(folder.path() / "results/latest/odometry.kitti"));
}

TEST_CASE("a live run whose sensor never comes ends well when it is stopped", "[app][live]") {
  LiveRun live;
  CHECK(live.program.interrupt() == 0);
}

TEST_CASE("what keeps a live run from starting is said in one line, before anything is written",
          "[app][live][refusals]") {
  const StreetFolder folder;
  const UdpSource taken({"127.0.0.1", 0});
  const std::string source = "run udp://127.0.0.1:" + std::to_string(taken.port());
  const std::string free = "run udp://127.0.0.1:0 --calibration calibration.yaml --set control.socket=none";
  const auto run = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  require_one_line_and_code_2(run(source + " --calibration calibration.yaml"),
                              "another program has the port");
  require_one_line_and_code_2(run("run udp://eth0:2368 --calibration calibration.yaml"), "eth0");
  require_one_line_and_code_2(run(free + " --set publish.udp=nowhere"), "publish.udp");
  require_one_line_and_code_2(run(free + " --set publish.shared_memory=a/b"), "shared memory");
  require_one_line_and_code_2(run(free + " --set publish.json_lines=no/folder/file"), "no/folder/file");
  require_one_line_and_code_2(run(free + " --record no/folder/live.pcap"), "no/folder/live.pcap");
  require_one_line_and_code_2(run("run street.pcap --record live.pcap"), "not live");
  require_one_line_and_code_2(run("run street.pcap --realtime --record street.pcap"), "is the source");
  require_one_line_and_code_2(run(free + " --speed 2"), "is live and keeps its own pace");
  require_one_line_and_code_2(run("record street.pcap -o live.pcap"), "is no live sensor");
  require_one_line_and_code_2(run("ctl status --socket nobody"), "no running pago listens there");
  require_one_line_and_code_2(run("ctl dance"), "dance");
  require_one_line_and_code_2(run("play missing.pcap"), "missing.pcap");
  require_one_line_and_code_2(run("play street.pcap --port 9"), "no datagram to port 9");
  require_one_line_and_code_2(run("play street.pcap --to 127.0.0.1:0"), "names no port");
  CHECK_FALSE(fs::exists(folder.path() / "results"));
}

TEST_CASE("a capture replayed in real time behaves as live, scans cannot be", "[app][live]") {
  const StreetFolder folder;
  const Outcome outcome = run_pago(folder.path(),
                                   "run street.pcap --realtime --set control.socket=none --set "
                                   "publish.shared_memory= --set publish.json_lines=poses.jsonl --set "
                                   "mount.height_m=1.2 --set ground.mount_check.sweeps=2");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_FALSE(read_text(folder.path() / "poses.jsonl").empty());
  const std::string log = read_text(folder.path() / "results/latest/log.txt");
  constexpr std::string_view kWarning = "mount.height_m is 1.20; try --set mount.height_m=1.7";
  CHECK(log.find(kWarning) != std::string::npos);
  const std::size_t first = outcome.err.find(kWarning);
  REQUIRE(first != std::string::npos);
  CHECK(outcome.err.find(kWarning, first + 1) == std::string::npos);  // said when it falls, and not again
}

TEST_CASE("a capture replayed at a quarter of its pace takes four times as long", "[app][live]") {
  const StreetFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run_pago(
      folder.path(), "run street.pcap --speed 0.25 --set control.socket=none --set publish.shared_memory=");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const double recorded_s = static_cast<double>(folder.num_packets() - 1) * 288e-6;
  CHECK(took.count() >= 4.0 * recorded_s);  // no faster; how much slower depends on the machine
}
