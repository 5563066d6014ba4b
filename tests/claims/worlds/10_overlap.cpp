// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What stands still is seen in the same place from sweep to sweep; what moves is not.
#include "tests/claims/worlds/overlap.hpp"

#include <array>
#include <string>

#include "tests/claims/report.hpp"

using namespace pago;
using claims::Cloud;
using claims::Report;

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
  config.seconds = 0.5;
  const auto sweeps = claims::clouds(config, [](std::uint64_t scan, const auto&) { return scan >= 2; });
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
  const auto sweeps =
      claims::clouds(config, [](std::uint64_t scan, const auto&) { return scan == 2 || scan == 7; });
  const Cloud &a = sweeps.front(), &b = sweeps.back();
  report.at_least("urban: part of moving things that is elsewhere half a second later",
                  claims::part_alone(a.moving, b.moving, b.from), 0.8, "");
  report.at_most("urban: part of what stands that is elsewhere half a second later",
                 claims::part_alone(a.standing, b.standing, b.from), 0.2, "");
}

}  // namespace

int main() {
  return claims::run("worlds: overlap", [](Report& report) {
    for (const auto& [world, name] : kWorlds)
      report.at_most(std::string(name) + ": surfaces from those of the sweep before, median",
                     consecutive_m(world), kBound_m, " m");
    check_movers(report);
  });
}
