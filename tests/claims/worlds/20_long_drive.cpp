// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Rendering along the whole of KITTI 02: how fast, and whether memory grows with the way. Then each world for
// a few seconds. CPU time of the one thread that casts; about ten minutes in all.
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <string>

#include "pago/config/config.hpp"
#include "pago/platform/clock.hpp"
#include "pago/simulator/simulator.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;
using simulator::SimulatedPacket;
using simulator::Simulator;

namespace {

constexpr double kLeastSweeps_s = 10.0;
constexpr std::uint64_t kPoses = 4661;
/// Land differs from place to place by so much; what grows with the way would be ten times as much at the
/// end.
constexpr double kMostGrowth = 1.25;

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double all = NAN, resident = NAN;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Renders up to the end of a rotation.
void render_until(Simulator& drive, std::uint64_t sweep, SimulatedPacket& packet) {
  const std::int64_t end_ns = drive.sweep(sweep - 1).end_ns;
  while (drive.next(packet) && packet.time_ns < end_ns) continue;
}

void check_kitti_02(Report& report) {
  SimulatorConfig config;
  config.path = claims::recording("kitti/poses/02.txt").string();
  config.seconds = 500.0;
  Simulator drive(config, {}, {});
  report.at_least("urban along KITTI 02: rotations", static_cast<double>(drive.num_sweeps()), kPoses - 5.0,
                  "");

  SimulatedPacket packet;
  const std::int64_t before_ns = platform::thread_cpu_ns();
  render_until(drive, drive.num_sweeps() / 4, packet);
  const double quarter_mb = resident_mb();
  while (drive.next(packet)) continue;
  const double cpu_s = static_cast<double>(platform::thread_cpu_ns() - before_ns) * 1e-9;
  report.at_least("urban along KITTI 02: rotations per second of CPU",
                  static_cast<double>(drive.num_sweeps()) / cpu_s, kLeastSweeps_s, " /s");
  report.at_most("urban along KITTI 02: resident at the end, of that at a quarter of the way",
                 resident_mb() / quarter_mb, kMostGrowth, format(" x %.0f MB", quarter_mb));
}

void check_speed(Report& report, SimulatedWorld world, const std::string& name) {
  SimulatorConfig config;
  config.world = world;
  config.start_speed_m_s = 15.0;
  config.seconds = 6.0;
  Simulator drive(config, {}, {});
  SimulatedPacket packet;
  render_until(drive, 10, packet);  // with the first tiles
  const std::int64_t before_ns = platform::thread_cpu_ns();
  while (drive.next(packet)) continue;
  const double cpu_s = static_cast<double>(platform::thread_cpu_ns() - before_ns) * 1e-9;
  report.at_least(name + ": rotations per second of CPU",
                  static_cast<double>(drive.num_sweeps() - 10) / cpu_s, kLeastSweeps_s, " /s");
}

}  // namespace

int main() {
  return claims::run("worlds: long drive", [](Report& report) {
    check_speed(report, SimulatedWorld::kUrban, "urban");
    check_speed(report, SimulatedWorld::kRural, "rural");
    check_speed(report, SimulatedWorld::kHighway, "highway");
    check_speed(report, SimulatedWorld::kTunnel, "tunnel");
    check_speed(report, SimulatedWorld::kField, "field");
    check_kitti_02(report);
  });
}
