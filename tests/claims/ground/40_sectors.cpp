// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Masks of sweeps that are segmented while they arrive, in 2 to 72 sectors, against those of whole sweeps:
// every sweep of the drive, and rough simulated ground, level and for a tilted sensor.
#include <vector>

#include "tests/claims/report.hpp"
#include "tests/ground/sectors.hpp"
#include "tests/support/recorded_sweeps.hpp"
#include "tests/support/scene.hpp"

using namespace pago;
using claims::Report;
using test::SectorWatch;

namespace {

constexpr int kMinSectors = 2, kMaxSectors = 72;

/// The methods that work on parts: by polar bins, and on the range image. The others wait for the sweep's
/// end.
std::vector<test::GroundCase> cases() {
  std::vector<test::GroundCase> result;
  for (const test::GroundCase& c : test::ground_cases())
    for (const char* name : {"patchwork", "patchwork-hdl64", "patchworkpp", "rgpf", "lego", "linefit"})
      if (c.name == name) result.push_back(c);
  return result;
}

void report(Report& out, const std::string& where, std::uint64_t sweeps, std::uint64_t expected, long wrong) {
  out.exactly("ground sectors: masks compared for each of the methods, " + where, sweeps, expected);
  out.exactly("ground sectors: returns whose mask differs, " + where, static_cast<std::uint64_t>(wrong), 0);
}

void on_drive(Report& out) {
  const auto folder = claims::recording("packets/drive_0005");
  std::uint64_t num_rotations = 0;  // the parts of one at either end included
  test::RecordedSweeps whole(folder / "drive_0005.pcap", folder / "calibration.yaml", 1,
                             [&](const SweepPart& part) { num_rotations += part.last ? 1U : 0U; });
  while (whole.next() != nullptr) {
  }
  SectorWatch watch(cases(), Mount{});
  watch.repeat();
  for (int sectors = kMinSectors; sectors <= kMaxSectors; ++sectors) {
    watch.begin_anew();
    test::RecordedSweeps drive(folder / "drive_0005.pcap", folder / "calibration.yaml", sectors,
                               [&](const SweepPart& part) { watch.take(part); });
    while (drive.next() != nullptr) {
    }
  }
  report(out, "drive_0005", static_cast<std::uint64_t>(watch.sweeps()),
         num_rotations * (kMaxSectors - kMinSectors + 1), watch.different());
}

void on_rough_ground(Report& out) {
  Sweep sweep(test::kMaxReturns);
  std::uint64_t compared = 0;
  long wrong = 0;
  for (const Mount& mount : {Mount{}, Mount{.roll_rad = -0.1, .pitch_rad = 0.15}}) {
    test::Scene()
        .ground(0.06, 0.03)
        .bumps(0.25, 7.0)
        .bumps(0.08, 1.3)
        .box({-40, 14, -3}, {40, 15, 5})
        .scan(sweep, {.mount = mount, .noise_m = 0.02});
    SectorWatch watch(cases(), mount);
    for (int sectors = kMinSectors; sectors <= kMaxSectors; ++sectors) {
      for (int k = 1; k < sectors; ++k) watch.take(test::part_of(sweep, static_cast<double>(k) / sectors));
      watch.take({&sweep, sweep.size, sweep.header.num_columns, true});
    }
    compared += static_cast<std::uint64_t>(watch.sweeps());
    wrong += watch.different();
  }
  report(out, "rough ground", compared, 2 * (kMaxSectors - kMinSectors + 1), wrong);
}

}  // namespace

int main() {
  return claims::run("ground sectors", [](Report& out) {
    on_rough_ground(out);
    on_drive(out);
  });
}
