// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Each optimised method against the plain double-precision reference that the tests keep, with the same
// settings, on real scans: every scan of KITTI's odometry benchmark that there is, the labelled one, and
// every tenth sweep of the drive. The figure is the scan that agrees least.
#include <algorithm>
#include <vector>

#include "pago/kitti/kitti_source.hpp"
#include "tests/claims/report.hpp"
#include "tests/ground/cases.hpp"
#include "tests/ground/reference/reference.hpp"
#include "tests/support/recorded_sweeps.hpp"

using namespace pago;
using claims::Report;

namespace {

constexpr double kMinAgreement_percent = 99.8;
constexpr int kEvery = 10;

/// A method and its reference, carried along a sequence.
struct Contest {
  std::string name;
  std::unique_ptr<ground::Segmenter> segmenter;
  test::Reference reference;
  double worst_percent = 100.0;

  void run(Sweep& sweep) {
    test::segment(*segmenter, sweep);
    worst_percent = std::min(worst_percent, 100.0 * (1.0 - test::share_different(sweep, reference(sweep))));
  }
};

std::vector<Contest> contests(const Mount& mount) {
  std::vector<Contest> all;
  for (const test::GroundCase& c : test::ground_cases())
    if (const test::Reference reference = test::make_reference(c.config, mount))
      all.push_back({c.name, ground::make_segmenter(c.config, mount, 300'000), reference});
  return all;
}

void report(Report& out, const std::vector<Contest>& all, const std::string& where) {
  for (const Contest& contest : all)
    out.at_least("ground exactness: " + contest.name + ", " + where, contest.worst_percent,
                 kMinAgreement_percent, " %");
}

void on_scans(Report& out, const std::string& folder) {
  std::vector<Contest> all = contests({.height_m = 1.723});
  KittiSource source(claims::recording(folder));
  Sweep sweep(KittiSource::kMaxPoints);
  int scans = 0;
  for (; source.fill(sweep); ++scans, sweep.reset())
    for (Contest& contest : all) contest.run(sweep);
  if (scans == 0) throw std::runtime_error(source.complaint());
  report(out, all, format("%d scans of KITTI", scans));
}

void on_drive(Report& out) {
  std::vector<Contest> all = contests(Mount{});
  const auto folder = claims::recording("packets/drive_0005");
  test::RecordedSweeps drive(folder / "drive_0005.pcap", folder / "calibration.yaml");
  int sweeps = 0;
  for (int i = 0; Sweep* sweep = drive.next(); ++i) {
    if (i % kEvery != 0) continue;
    ++sweeps;
    for (Contest& contest : all) contest.run(*sweep);
  }
  report(out, all, format("%d sweeps from packets", sweeps));
}

}  // namespace

int main() {
  return claims::run("ground exactness", [](Report& out) {
    on_scans(out, "kitti/odometry_00_000000-000015");
    on_scans(out, "kitti/semantickitti_single");
    on_drive(out);
  });
}
