// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// How rough road and grass are to the sensor: the range of a return against those of its neighbours in the
// ring, on SemanticKITTI's labelled scan and in the simulator. Not smoother than reality, and not several
// times as rough.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/simulator/scan_collector.hpp"
#include "drivers/simulator/surface.hpp"
#include "pago/config/config.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/simulator/simulator.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;
using simulator::Label;
using simulator::Simulator;

namespace {

/// Ring by ring, neighbours one after the other.
struct Return {
  double range_m = 0.0, turn_rad = 0.0;
  std::uint32_t label = 0;
};
using Scan = std::vector<Return>;

Scan real_scan() {
  KittiSource source(claims::recording("kitti/semantickitti_single"));
  Sweep sweep(KittiSource::kMaxPoints);
  if (!source.fill(sweep)) throw std::runtime_error("the scan cannot be read: " + source.complaint());
  Scan scan;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const double x_m{sweep.x_m[i]}, y_m{sweep.y_m[i]}, z_m{sweep.z_m[i]};
    scan.push_back({std::hypot(x_m, y_m, z_m), std::atan2(y_m, x_m), sweep.label[i]});
  }
  return scan;
}

Scan simulated_scan(SimulatedWorld world) {
  SimulatorConfig config;
  config.world = world;
  config.seed = 3;
  config.start_speed_m_s = 8.0;
  config.seconds = 0.3;
  Simulator drive(config, {}, {});
  Scan scan;
  const auto use = [&](std::uint64_t, const simulator::LabelledRings& rings) {
    for (const auto& ring : rings)
      for (const simulator::LabelledPoint& p : ring)
        scan.push_back(
            {std::hypot(double{p.x_m}, double{p.y_m}, double{p.z_m}), double{p.turn_rad}, p.label});
  };
  simulator::ScanCollector collector(drive, {}, false, use);
  simulator::SimulatedPacket packet;
  while (drive.next(packet)) collector.add(packet);
  collector.finish(drive.num_sweeps());
  return scan;
}

/// Robust deviation of a range from the mean of its neighbours', for surfaces so far away.
double roughness_m(const Scan& scan, Label label, double from_m, double to_m) {
  constexpr double kNeighbour_rad = 0.006, kMadToSigma = 1.4826;
  constexpr std::size_t kLeast = 300;
  std::vector<double> jumps;
  for (std::size_t i = 1; i + 1 < scan.size(); ++i) {
    const Return &a = scan[i - 1], &b = scan[i], &c = scan[i + 1];
    const auto is_next = [](const Return& p, const Return& q) {
      return p.label == q.label &&
             std::abs(std::remainder(p.turn_rad - q.turn_rad, 2.0 * std::numbers::pi)) < kNeighbour_rad;
    };
    if (b.label != static_cast<std::uint32_t>(label) || b.range_m < from_m || b.range_m >= to_m) continue;
    if (is_next(a, b) && is_next(b, c)) jumps.push_back(std::abs(b.range_m - 0.5 * (a.range_m + c.range_m)));
  }
  if (jumps.size() < kLeast) return NAN;
  const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
  std::ranges::nth_element(jumps, middle);
  return kMadToSigma * *middle / std::sqrt(1.5);
}

void compare(Report& report,
             const std::string& name,
             Label label,
             const Scan& real,
             const Scan& simulated,
             double most_times) {
  constexpr std::array<std::array<double, 2>, 4> kRanges_m{{{5, 10}, {10, 15}, {15, 20}, {20, 30}}};
  for (const auto& [from_m, to_m] : kRanges_m) {
    const double real_m = roughness_m(real, label, from_m, to_m);
    const double ratio = roughness_m(simulated, label, from_m, to_m) / real_m;
    const std::string claim =
        name + format(", %.0f to %.0f m: of KITTI's %.0f mm", from_m, to_m, 1000.0 * real_m);
    report.at_least(claim, ratio, 0.8, " times");
    report.at_most(claim, ratio, most_times, " times");
  }
}

}  // namespace

int main() {
  return claims::run("worlds: roughness", [](Report& report) {
    const Scan real = real_scan(), rural = simulated_scan(SimulatedWorld::kRural),
               urban = simulated_scan(SimulatedWorld::kUrban);
    compare(report, "rural: terrain", Label::kTerrain, real, rural, 4.0);
    compare(report, "urban: road", Label::kRoad, real, urban, 3.0);
  });
}
