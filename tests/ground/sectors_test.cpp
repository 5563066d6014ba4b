// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps that are segmented while they arrive. tests/claims/ground does the same with every sweep of the
// drive and every number of sectors.
#include <algorithm>
#include <numbers>

#include "src/ground/concentric_zones.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/recorded_sweeps.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"
#include "tests/ground/sectors.hpp"

using namespace pago;
using namespace pago::test;

namespace {

/// A bumpy field on a slope with a wall and a ditch.
Scene rough() {
  Scene scene;
  scene.ground(0.06, 0.03).bumps(0.25, 7.0).bumps(0.08, 1.3).box({-40, 14, -3}, {40, 15, 5});
  return scene;
}

}  // namespace

TEST_CASE("sweeps of the drive get the same mask in sectors as whole", "[ground][sectors]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  for (const int sectors : {2, 7, 72}) {
    SectorWatch watch(Mount{});
    RecordedSweeps sweeps(folder / "drive_0005.pcap", folder / "calibration.yaml", sectors,
                          [&](const SweepPart& part) { watch.take(part); });
    for (int i = 0; i < 6; ++i) REQUIRE(sweeps.next() != nullptr);
    INFO(sectors << " sectors: " << watch.complaint());
    CHECK(watch.sweeps() >= 6);
    CHECK(watch.parts() >= 5 * sectors);
    CHECK(watch.complaint().empty());
  }
}

TEST_CASE("rough ground gets the same mask in sectors as whole", "[ground][sectors]") {
  Sweep sweep(kMaxReturns);
  Mount tilted;
  tilted.pitch_rad = 0.15;
  tilted.roll_rad = -0.1;
  for (const Mount& mount : {Mount{}, tilted}) {
    rough().scan(sweep, {.mount = mount, .noise_m = 0.02});
    SectorWatch watch(mount);
    for (const int sectors : {1, 2, 3, 8, 36, 72}) {
      for (int k = 1; k < sectors; ++k) watch.take(part_of(sweep, static_cast<double>(k) / sectors));
      watch.take({&sweep, sweep.size, sweep.header.num_columns, true});
      INFO(sectors << " sectors, pitch " << mount.pitch_rad << ": " << watch.complaint());
      CHECK(watch.complaint().empty());
    }
  }
}

TEST_CASE("returns that come where the head has long been do not change the mask", "[ground][sectors]") {
  Sweep sweep(kMaxReturns);
  rough().scan(sweep, {.noise_m = 0.02});
  // A tenth of a turn away from where their columns say: behind the sweep's back.
  for (std::uint32_t i = sweep.size / 2; i < sweep.size; i += 97) {
    const float x = sweep.x_m[i], y = sweep.y_m[i];
    sweep.x_m[i] = 0.8F * x - 0.6F * y;
    sweep.y_m[i] = 0.6F * x + 0.8F * y;
  }
  SectorWatch watch(Mount{});
  for (int k = 1; k < 36; ++k) watch.take(part_of(sweep, k / 36.0));
  watch.take({&sweep, sweep.size, sweep.header.num_columns, true});
  INFO(watch.complaint());
  CHECK(watch.complaint().empty());
}

TEST_CASE("most bins are sorted before the sweep has ended", "[ground][sectors]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  using namespace pago::ground;
  PolarBins bins(concentric_zones("zones", 2.7, 80.0, {2, 4, 4, 4}, {16, 32, 54, 32}), 400'000);
  int early = 0, rest = 0;
  bins.begin();
  RecordedSweeps sweeps(
      folder / "drive_0005.pcap", folder / "calibration.yaml", 36, [&](const SweepPart& part) {
        const Coordinates returns{part.sweep->x_m.data(), part.sweep->y_m.data(), part.sweep->z_m.data()};
        bins.locate(returns, part.returns_until, -1e6F);
        if (part.last) {
          bins.sort_rest(returns);
        } else {
          bins.sort_swept(returns, swept_arc(part, returns));
        }
        for (int bin = 0; bin < bins.grid().num_bins(); ++bin)
          (part.last ? rest : early) += bins.is_fresh(bin) ? 1 : 0;
        if (part.last) bins.begin();
      });
  for (int i = 0; i < 4; ++i) REQUIRE(sweeps.next() != nullptr);
  CHECK(early > 3 * rest);  // the first columns stay open to the end, for lasers that look behind
  CHECK((early + rest) % bins.grid().num_bins() == 0);  // each bin once a sweep
}

TEST_CASE("an arc holds what lies wholly in it, across the turn too", "[ground][swept_arc]") {
  using ground::SweptArc;
  const SweptArc arc{0.45F, 0.3F};  // from 0.45 clockwise to 0.15
  CHECK(arc.holds(0.2F, 0.4F));
  CHECK(arc.holds(0.15F + 1e-6F, 0.45F));
  CHECK_FALSE(arc.holds(0.1F, 0.2F));
  CHECK_FALSE(arc.holds(0.4F, 0.5F));
  const SweptArc across{0.1F, 0.3F};  // through 0 down to 0.8
  CHECK(across.holds(0.0F, 0.05F));
  CHECK(across.holds(0.9F, 1.0F));
  CHECK_FALSE(across.holds(0.7F, 0.85F));
  CHECK_FALSE(SweptArc{}.holds(0.5F, 0.6F));
}

TEST_CASE("the swept arc lies between the first closed columns and the last", "[ground][swept_arc]") {
  Sweep sweep(kMaxReturns);
  Scene().level_ground().scan(sweep, {.columns = 2000});
  const ground::Coordinates returns{sweep.x_m.data(), sweep.y_m.data(), sweep.z_m.data()};
  CHECK(ground::swept_arc({&sweep, 0, 0, false}, returns).width_turns == 0.0F);
  CHECK(ground::swept_arc(part_of(sweep, 0.09), returns).width_turns == 0.0F);
  const ground::SweptArc half = ground::swept_arc(part_of(sweep, 0.5), returns);
  const double margin = 2.0 / 360.0;
  CHECK(half.start_turns == Approx(0.5 - 192.0 / 2000.0 - margin).margin(1e-3));
  CHECK(half.width_turns == Approx(0.5 - 192.0 / 2000.0 - 2.0 * margin).margin(1e-3));
}
