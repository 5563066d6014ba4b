// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("a capture becomes a results folder with a pose per sweep", "[app][run]") {
  const StreetFolder folder;
  const Outcome outcome = run_pago(folder.path(), "run street.pcap");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  REQUIRE(outcome.out.find("4 with a pose") != std::string::npos);
  const fs::path results = folder.path() / "results" / "latest";
  for (const char* name : {"odometry.tum", "odometry.kitti", "trajectory.tum", "trajectory.kitti"}) {
    REQUIRE(count_lines(read_text(results / name)) == 4);
  }
  REQUIRE(fs::file_size(results / "run.json") > 100);
  REQUIRE(fs::file_size(results / "latency.csv") > 100);
  REQUIRE(fs::file_size(results / "trace.json") > 100);

  SECTION("the same capture gives the same bytes again, on one core too") {
    const std::string poses = read_text(results / "trajectory.kitti");
    REQUIRE(run_pago(folder.path(), "run street.pcap --output again").exit_code == 0);
    REQUIRE(read_text(folder.path() / "again" / "latest" / "trajectory.kitti") == poses);
  }
  SECTION("a mount that the ground contradicts is warned about, with the estimate") {
    const Outcome wrong = run_pago(folder.path(), "run street.pcap --set mount.height_m=1.2");
    REQUIRE(wrong.exit_code == 0);
    REQUIRE(wrong.err.find("mount.height_m is 1.20; try --set mount.height_m=1.7") != std::string::npos);
    REQUIRE(outcome.err.find("mount") == std::string::npos);
  }
  SECTION("an estimated height is shown and kept") {
    const Outcome estimated =
        run_pago(folder.path(), "run street.pcap --set mount.height_m=1.6 --set ground.height.enabled=true");
    INFO(estimated.out << estimated.err);
    REQUIRE(estimated.out.find("height    1.7") != std::string::npos);
    REQUIRE(estimated.out.find("mount.height_m is 1.60") != std::string::npos);
    REQUIRE(read_text(results / "run.json").find("\"sensor height, estimated\": \"1.7") != std::string::npos);
    REQUIRE(outcome.out.find("estimated for the ground") == std::string::npos);
  }
  SECTION("what it wrote can be scored") {
    const Outcome score = run_pago(
        folder.path(), "evaluate results/latest/trajectory.tum results/latest/odometry.tum --lengths 1");
    REQUIRE(score.exit_code == 0);
    REQUIRE(score.out.find("SE(3)") != std::string::npos);
  }
}

TEST_CASE("a signal ends a run early with every file complete", "[app][run]") {
  const StreetFolder folder(20);
  RunningProgram program(folder.path(), {"run", "street.pcap"});
  // Once the first files exist the handlers are about to be set; a moment later they are.
  program.wait_for("results/latest/latency.csv");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  REQUIRE(program.interrupt() == 0);
  const fs::path results = folder.path() / "results" / "latest";
  REQUIRE(read_text(results / "run.json").find("\"sweeps\"") != std::string::npos);
  REQUIRE(count_lines(read_text(results / "trajectory.tum")) ==
          count_lines(read_text(results / "odometry.kitti")));
}

TEST_CASE("bad input ends with one clear line and code 2", "[app][refusals]") {
  const StreetFolder folder(1);
  const auto run = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  };

  require_one_line_and_code_2(run("run missing.pcap"), "missing.pcap");
  require_one_line_and_code_2(run("run street.pcap --calibration missing.xml"), "missing.xml");
  require_one_line_and_code_2(run("run street.pcap --set ground.methd=lego"), "ground.method");
  require_one_line_and_code_2(run("run street.pcap --set mount.height_m=tall"), "mount.height_m");
  require_one_line_and_code_2(run("run street.pcap --set mount.height_m=-3"), "mount.height_m");
  require_one_line_and_code_2(run("run street.pcap --ground lawn"), "patchwork");
  require_one_line_and_code_2(run("run street.pcap --ground truth"), "has no labels");
  require_one_line_and_code_2(run("run street.pcap --set packets.port=9"), "packets.port");
  require_one_line_and_code_2(run("run stree.pcap --sat x=1"), "--sat");
  require_one_line_and_code_2(run("drive --help"), "no command 'drive'");
  require_one_line_and_code_2(run("run kitti:"), "has no name");
  require_one_line_and_code_2(run("run velodyne/000000.bin"), "folder");
  require_one_line_and_code_2(run("evaluate a.tum b.tum --lengths -1"), "-1 is no number above 0");
  require_one_line_and_code_2(run(""), "no command");
  require_one_line_and_code_2(run("evaluate missing.tum missing.tum"), "missing.tum");
  write("broken.toml", "[ground]\nmethod = 3\n");
  require_one_line_and_code_2(run("config --config broken.toml"), "broken.toml:2");
  write("text.pcap", "this is no capture at all, whatever its name says");
  require_one_line_and_code_2(run("run text.pcap"), "text.pcap");
  fs::create_directories(folder.path() / "empty");
  require_one_line_and_code_2(run("run empty"), "empty");
  const std::string yaml = read_text(folder.path() / "calibration.yaml");
  write("calibration.yaml", yaml.substr(0, yaml.size() / 2));
  require_one_line_and_code_2(run("run street.pcap"), "calibration.yaml");
  fs::remove(folder.path() / "calibration.yaml");
  require_one_line_and_code_2(run("run street.pcap"), "--calibration");
  REQUIRE_FALSE(fs::exists(folder.path() / "results"));
}

TEST_CASE("help and version answer, and the printed settings can be read back", "[app][help]") {
  const TemporaryPath folder("");
  fs::create_directories(folder.path());
  REQUIRE(run_pago(folder.path(), "--help").out.find("run") != std::string::npos);
  REQUIRE(run_pago(folder.path(), "run --help").exit_code == 0);
  REQUIRE(run_pago(folder.path(), "--version").out.find("pago ") == 0);
  REQUIRE(run_pago(folder.path(), "config --set mount.height_m=1.5").exit_code == 0);
  fs::rename(folder.path() / "stdout", folder.path() / "settings.toml");
  REQUIRE(run_pago(folder.path(), "config --config settings.toml").out.find("height_m = 1.5") !=
          std::string::npos);
}

TEST_CASE("captures of other sensors are refused by name", "[app][refusals]") {
  PAGO_DATA_OR_SKIP(captures, "packets/captures");
  const TemporaryPath folder("");
  fs::create_directories(folder.path());
  const fs::path calibration = data_folder() / "packets/drive_0005/calibration.yaml";
  const auto run = [&](const char* name) {
    return run_pago(folder.path(),
                    "run '" + (captures / name).string() + "' --calibration '" + calibration.string() + "'");
  };
  require_one_line_and_code_2(run("monterey-first-100-packets.pcap"), "HDL-32E");
  require_one_line_and_code_2(run("vlp-16-test-90deg-1-50-frames.pcap"), "VLP-16");
  require_one_line_and_code_2(run("scanparser-vlp16.pcap"), "VLP-16");
}
