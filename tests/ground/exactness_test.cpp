// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Each optimised method against its plain double-precision reference, on real scans and on exact geometry
// full of ties. tests/claims/ground does the same on every scan there is.
#include <cstdio>
#include <functional>

#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/kitti_scan.hpp"
#include "support/recorded_sweeps.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"
#include "tests/ground/reference/reference.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr double kMaxDifferent = 0.002;

/// Both, carried along a sequence of sweeps.
struct Contest {
  std::string name;
  std::unique_ptr<ground::Segmenter> segmenter;
  Reference reference;
  double worst = 0.0;

  void run(Sweep& sweep) {
    INFO(name);
    segment(*segmenter, sweep);
    const double different = share_different(sweep, reference(sweep));
    CHECK(different <= kMaxDifferent);
    worst = std::max(worst, different);
  }
};

std::vector<Contest> contests(const Mount& mount) {
  std::vector<Contest> all;
  for (const GroundCase& c : ground_cases())
    if (const Reference reference = make_reference(c.config, mount))
      all.push_back({c.name, ground::make_segmenter(c.config, mount, kMaxReturns), reference});
  return all;
}

void report(const std::vector<Contest>& all, const char* where) {
  for (const Contest& contest : all)
    std::printf("%-16s against its reference, %s: worst %.4f %% of returns differ\n", contest.name.c_str(),
                where, 100.0 * contest.worst);
}

}  // namespace

TEST_CASE("methods agree with their references on KITTI scans", "[ground][exactness]") {
  PAGO_DATA_OR_SKIP(folder, "kitti");
  const auto files = kitti_scans(folder / "odometry_00_000000-000015" / "velodyne");
  Sweep sweep(kMaxReturns);
  std::vector<Contest> all = contests({.height_m = 1.723});
  for (const auto& file :
       {files.at(0), files.at(8), folder / "semantickitti_single" / "velodyne" / "000000.bin"}) {
    load_kitti_points(file, sweep);
    for (Contest& contest : all) contest.run(sweep);
  }
  report(all, "KITTI");
}

TEST_CASE("methods agree with their references for a tilted sensor", "[ground][exactness]") {
  PAGO_DATA_OR_SKIP(folder, "kitti");
  Sweep sweep(kMaxReturns);
  load_kitti_points(folder / "semantickitti_single" / "velodyne" / "000000.bin", sweep);
  for (Contest& contest : contests({.height_m = 1.723, .roll_rad = 0.01, .pitch_rad = -0.02, .yaw_rad = 0.3}))
    contest.run(sweep);
}

TEST_CASE("methods agree with their references on sweeps decoded from packets", "[ground][exactness]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  std::vector<Contest> all = contests(Mount{});
  RecordedSweeps sweeps(folder / "drive_0005.pcap", folder / "calibration.yaml");
  for (int i = 0; i <= 60; ++i) {
    Sweep* sweep = sweeps.next();
    REQUIRE(sweep != nullptr);
    if (i % 30 != 0) continue;
    for (Contest& contest : all) contest.run(*sweep);
  }
  report(all, "drive_0005");
}

TEST_CASE("methods agree with their references on exact geometry full of ties", "[ground][exactness]") {
  Sweep sweep(kMaxReturns);
  // Not 2,083 columns: CascadedSeg's own grid has as many, and each return would lie on a border of it.
  const Scene scene = Scene().level_ground().box({8, -2, 0}, {12, -0.2, 1.5}).box({-60, 12, 0}, {60, 13, 6});
  scene.scan(sweep, {.columns = 2000});
  for (Contest& contest : contests(Mount{})) contest.run(sweep);
}
