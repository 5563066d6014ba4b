// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/pcap_writer.hpp"
#include "support/street_packets.hpp"
#include "support/temporary_path.hpp"

namespace pago::test {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Runs the program in `folder` as a shell would, to its end.
inline Outcome run_pago(const fs::path& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.string() + "' && '" PAGO_PROGRAM "' " + arguments + " >stdout 2>stderr";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "stdout"),
          read_text(folder / "stderr")};
}

inline void require_one_line_and_code_2(const Outcome& outcome, const std::string& mentions) {
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 2);
  REQUIRE(count_lines(outcome.err) == 1);
  REQUIRE(outcome.err.find(mentions) != std::string::npos);
}

/// The program at work in a folder, until it is interrupted.
class RunningProgram {
 public:
  RunningProgram(fs::path folder, const std::vector<std::string>& arguments)
      : folder_(std::move(folder)), child_(fork()) {
    if (child_ != 0) return;
    std::vector<char*> words{const_cast<char*>("pago")};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const bool is_ready = chdir(folder_.c_str()) == 0 && std::freopen("out.txt", "w", stdout) != nullptr &&
                          std::freopen("err.txt", "w", stderr) != nullptr;
    if (is_ready) execv(PAGO_PROGRAM, words.data());
    _exit(127);
  }
  ~RunningProgram() {
    if (child_ > 0) interrupt();
  }

  /// Until it has made this file.
  void wait_for(const std::string& file) const {
    for (int i = 0; i < 4000 && !fs::exists(folder_ / file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    REQUIRE(fs::exists(folder_ / file));
  }
  /// Asks it to end; its exit code, or -1.
  int interrupt() {
    kill(child_, SIGINT);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  fs::path folder_;
  pid_t child_;
};

/// A folder with the street of the pipeline tests as a capture, street.pcap, and its calibration as a ROS
/// yaml beside it.
class StreetFolder {
 public:
  explicit StreetFolder(int sweeps = 4) : folder_("") {
    fs::create_directories(path());
    Vector6d twist = Vector6d::Zero();
    twist[0] = 6.0;
    write_packets(drive_packets(twist, sweeps));
    write_calibration();
  }

  const fs::path& path() const { return folder_.path(); }
  fs::path capture() const { return path() / "street.pcap"; }
  std::size_t num_packets() const { return num_packets_; }

 private:
  void write_packets(const std::vector<PacketBytes>& packets) {
    num_packets_ = packets.size();
    PcapWriter writer(capture());
    for (std::size_t i = 0; i < packets.size(); ++i)
      writer.write_udp(packets[i], 1'700'000'100'000'000'000 + static_cast<std::int64_t>(i) * 288'000);
  }
  void write_calibration() const {
    std::ofstream yaml(path() / "calibration.yaml");
    yaml << "distance_resolution: 0.002\nnum_lasers: 64\nlasers:\n";
    const hdl64::Calibration calibration = ideal_calibration();
    for (int laser = 0; laser < 64; ++laser) {
      yaml << "- {laser_id: " << laser
           << ", vert_correction: " << calibration.lasers[static_cast<std::size_t>(laser)].vertical_rad
           << ", rot_correction: 0.0, dist_correction: 0.0, dist_correction_x: 0.0, dist_correction_y: 0.0, "
              "vert_offset_correction: 0.0, horiz_offset_correction: 0.0}\n";
    }
  }

  TemporaryPath folder_;
  std::size_t num_packets_ = 0;
};

}  // namespace pago::test
