// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/pcap_writer.hpp"
#include "support/street_packets.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
namespace fs = std::filesystem;

namespace {

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Runs the program in `folder` as a shell would.
Outcome run_pago(const fs::path& folder, const std::string& arguments) {
  const fs::path out = folder / "stdout", err = folder / "stderr";
  const std::string command =
      "cd '" + folder.string() + "' && '" PAGO_PROGRAM "' " + arguments + " >stdout 2>stderr";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
}

/// The street of the pipeline tests as a capture, with its calibration as a ROS yaml beside it.
fs::path write_capture(const fs::path& folder, int sweeps) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = 6.0;
  const std::vector<test::PacketBytes> packets = test::drive_packets(twist, sweeps);
  const fs::path capture = folder / "street.pcap";
  {
    test::PcapWriter writer(capture);
    for (std::size_t i = 0; i < packets.size(); ++i) {
      writer.write_udp(packets[i], 1'700'000'100'000'000'000 + static_cast<std::int64_t>(i) * 288'000);
    }
  }
  std::ofstream yaml(folder / "calibration.yaml");
  yaml << "distance_resolution: 0.002\nnum_lasers: 64\nlasers:\n";
  const hdl64::Calibration calibration = test::ideal_calibration();
  for (int laser = 0; laser < 64; ++laser) {
    yaml << "- {laser_id: " << laser
         << ", vert_correction: " << calibration.lasers[static_cast<std::size_t>(laser)].vertical_rad
         << ", rot_correction: 0.0, dist_correction: 0.0, dist_correction_x: 0.0, dist_correction_y: 0.0, "
            "vert_offset_correction: 0.0, horiz_offset_correction: 0.0}\n";
  }
  return capture;
}

void require_one_line_and_code_2(const Outcome& outcome, const std::string& mentions) {
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 2);
  REQUIRE(lines(outcome.err) == 1);
  REQUIRE(outcome.err.find(mentions) != std::string::npos);
}

}  // namespace

TEST_CASE("a capture becomes a results folder with a pose per sweep", "[app][run]") {
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path());
  write_capture(folder.path(), 4);
  const Outcome outcome = run_pago(folder.path(), "run street.pcap");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  REQUIRE(outcome.out.find("4 with a pose") != std::string::npos);
  const fs::path results = folder.path() / "results" / "latest";
  for (const char* name : {"odometry.tum", "odometry.kitti", "trajectory.tum", "trajectory.kitti"}) {
    REQUIRE(lines(read(results / name)) == 4);
  }
  REQUIRE(fs::file_size(results / "run.json") > 100);
  REQUIRE(fs::file_size(results / "latency.csv") > 100);
  REQUIRE(fs::file_size(results / "trace.json") > 100);

  SECTION("the same capture gives the same bytes again, on one core too") {
    const std::string poses = read(results / "trajectory.kitti");
    REQUIRE(run_pago(folder.path(), "run street.pcap --output again").exit_code == 0);
    REQUIRE(read(folder.path() / "again" / "latest" / "trajectory.kitti") == poses);
  }
  SECTION("a mount that the ground contradicts is warned about, with the estimate") {
    const Outcome wrong = run_pago(folder.path(),
                                   "run street.pcap --set mount.height_m=1.2 --set ground.mount_check.sweeps=3");
    REQUIRE(wrong.exit_code == 0);
    REQUIRE(wrong.err.find("mount.height_m is 1.20; try --set mount.height_m=1.7") != std::string::npos);
    REQUIRE(outcome.err.find("mount") == std::string::npos);
  }
  SECTION("what it wrote can be scored") {
    const Outcome score = run_pago(
        folder.path(), "evaluate results/latest/trajectory.tum results/latest/odometry.tum --lengths 1");
    REQUIRE(score.exit_code == 0);
    REQUIRE(score.out.find("SE(3)") != std::string::npos);
  }
}

TEST_CASE("a signal ends a run early with every file complete", "[app][run]") {
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path());
  const fs::path capture = write_capture(folder.path(), 20);
  const std::string output = (folder.path() / "results").string();
  const pid_t child = fork();
  if (child == 0) {
    execl(PAGO_PROGRAM, "pago", "run", capture.c_str(), "--output", output.c_str(), nullptr);
    _exit(127);
  }
  // Once the first files exist the handlers are about to be set; a moment later they are.
  while (!fs::exists(fs::path(output) / "latest" / "latency.csv"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGINT);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == 0);
  const fs::path results = fs::path(output) / "latest";
  REQUIRE(read(results / "run.json").find("\"sweeps\"") != std::string::npos);
  REQUIRE(lines(read(results / "trajectory.tum")) == lines(read(results / "odometry.kitti")));
}

TEST_CASE("bad input ends with one clear line and code 2", "[app][refusals]") {
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path());
  const fs::path capture = write_capture(folder.path(), 1);
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
  require_one_line_and_code_2(run("drive"), "drive");
  require_one_line_and_code_2(run(""), "no command");
  require_one_line_and_code_2(run("evaluate missing.tum missing.tum"), "missing.tum");
  write("broken.toml", "[ground]\nmethod = 3\n");
  require_one_line_and_code_2(run("config --config broken.toml"), "broken.toml:2");
  write("text.pcap", "this is no capture at all, whatever its name says");
  require_one_line_and_code_2(run("run text.pcap"), "text.pcap");
  fs::create_directories(folder.path() / "empty");
  require_one_line_and_code_2(run("run empty"), "empty");
  const std::string yaml = read(folder.path() / "calibration.yaml");
  write("calibration.yaml", yaml.substr(0, yaml.size() / 2));
  require_one_line_and_code_2(run("run street.pcap"), "calibration.yaml");
  fs::remove(folder.path() / "calibration.yaml");
  require_one_line_and_code_2(run("run street.pcap"), "--calibration");
  REQUIRE_FALSE(fs::exists(folder.path() / "results"));
}

TEST_CASE("help and version answer, and the printed settings can be read back", "[app][help]") {
  const test::TemporaryPath folder("");
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
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path());
  const fs::path calibration = test::data_folder() / "packets/drive_0005/calibration.yaml";
  const auto run = [&](const char* name) {
    return run_pago(folder.path(),
                    "run '" + (captures / name).string() + "' --calibration '" + calibration.string() + "'");
  };
  require_one_line_and_code_2(run("monterey-first-100-packets.pcap"), "HDL-32E");
  require_one_line_and_code_2(run("vlp-16-test-90deg-1-50-frames.pcap"), "VLP-16");
  require_one_line_and_code_2(run("scanparser-vlp16.pcap"), "VLP-16");
}
