// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What stands still is seen in the same place from sweep to sweep; what moves is not.
#include "tests/claims/worlds/overlap.hpp"

#include <array>
#include <cmath>
#include <string>

#include "tests/claims/report.hpp"

using namespace pago;
using claims::Cloud;
using claims::Report;
using simulator::Simulator;

namespace {

constexpr double kBound_m = 0.03;
constexpr std::array<std::pair<SimulatedWorld, const char*>, 5> kWorlds{
    {{SimulatedWorld::kUrban, "urban"},
     {SimulatedWorld::kRural, "rural"},
     {SimulatedWorld::kHighway, "highway"},
     {SimulatedWorld::kTunnel, "tunnel"},
     {SimulatedWorld::kField, "field"}}};

SimulatorConfig drive_in(SimulatedWorld world) {
  SimulatorConfig config;
  config.world = world;
  config.seed = 3;
  config.start_speed_m_s = 10.0;
  return config;
}

double consecutive_m(SimulatedWorld world) {
  SimulatorConfig config = drive_in(world);
  config.seconds = 0.6;
  Simulator drive(config, {}, {});
  const auto sweeps = claims::clouds(drive, {2, 3, 4});
  std::vector<double> apart;
  for (std::size_t i = 1; i < sweeps.size(); ++i)
    apart.push_back(claims::surfaces_apart_m(sweeps[i - 1], sweeps[i]));
  return claims::median(std::move(apart));
}

/// Sweeps half a second apart: beams lie as dense on cars as on walls, but only walls stay.
void check_movers(Report& report) {
  SimulatorConfig config = drive_in(SimulatedWorld::kUrban);
  config.traffic = 4.0;
  config.seconds = 0.9;
  Simulator drive(config, {}, {});
  const auto sweeps = claims::clouds(drive, {2, 7});
  const Cloud &a = sweeps.front(), &b = sweeps.back();
  report.at_least("urban: part of moving things that is elsewhere half a second later",
                  claims::part_alone(a.moving, b.moving, b.from), 0.8, "");
  report.at_most("urban: part of what stands that is elsewhere half a second later",
                 claims::part_alone(a.standing, b.standing, b.from), 0.2, "");
}

/// Rotations of a round trip whose middles are closest together, at least so far apart on the way.
struct Revisit {
  std::uint64_t first = 0, again = 0;
  double way_m = 0.0, apart_m = HUGE_VAL;
};

Revisit find_revisit(const Simulator& drive, double least_way_m) {
  std::vector<Eigen::Vector3d> at;
  std::vector<double> way_m{0.0};
  for (std::uint64_t i = 0; i + 1 < drive.num_sweeps(); ++i) {
    at.push_back(drive.T_world_sensor(drive.sweep(i).mid_ns).translation());
    if (i > 0) way_m.push_back(way_m.back() + (at[i] - at[i - 1]).norm());
  }
  Revisit best;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      if (way_m[j] - way_m[i] < least_way_m || (at[i] - at[j]).norm() >= best.apart_m) continue;
      best = {i, j, way_m[j] - way_m[i], (at[i] - at[j]).norm()};
    }
  }
  return best;
}

void check_revisit(Report& report) {
  SimulatorConfig config = drive_in(SimulatedWorld::kUrban);
  config.loop_m = 1000.0;
  config.seconds = 200.0;
  Simulator drive(config, {}, {});
  const Revisit revisit = find_revisit(drive, 800.0);
  report.at_most(format("urban: a place seen again after %.0f m, from a place so far beside", revisit.way_m),
                 revisit.apart_m, 1.0, " m");
  const auto sweeps = claims::clouds(drive, {revisit.first, revisit.again});
  report.at_most("urban: its surfaces from those of the first visit, median",
                 claims::surfaces_apart_m(sweeps.front(), sweeps.back()), kBound_m, " m");
}

}  // namespace

int main() {
  return claims::run("worlds: overlap", [](Report& report) {
    for (const auto& [world, name] : kWorlds)
      report.at_most(std::string(name) + ": surfaces from those of the sweep before, median",
                     consecutive_m(world), kBound_m, " m");
    check_revisit(report);
    check_movers(report);
  });
}
