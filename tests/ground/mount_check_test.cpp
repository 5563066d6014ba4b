// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "pago/core/units.hpp"
#include "pago/ground/ground_stage.hpp"
#include "support/alloc_guard.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/recorded_sweeps.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::ground;
using namespace pago::test;
using Catch::Contains;

static_assert(Stage<GroundStage>);

namespace {

/// A street between houses, with cars.
Scene street_with_cars() {
  Scene scene;
  scene.level_ground()
      .box({-60, 9, 0}, {60, 12, 8})
      .box({-60, -12, 0}, {60, -9, 8})
      .box({8, -2, 0}, {12, -0.2, 1.5})
      .box({-14, 3.5, 0}, {-10, 5.3, 1.5});
  return scene;
}

/// The report of a stage that believes in `believed` on a sensor that sits as `real`.
MountReport check(const Mount& real, const Mount& believed, const Scene& scene = street_with_cars()) {
  Sweep sweep(kMaxReturns);
  GroundConfig config;
  config.mount_check.sweeps = 5;
  GroundStage stage(config, believed, sweep.capacity());
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    CHECK(stage.mount_report().finding == MountFinding::kPending);
    scene.scan(sweep, {.mount = real, .noise_m = 0.02, .seed = seed});
    stage.begin(sweep);
    stage.finish(sweep);
  }
  return stage.mount_report();
}

/// The mount that a report's estimate stands for.
Mount estimate(const MountReport& report) {
  return {.height_m = report.height_m, .roll_rad = report.roll_rad, .pitch_rad = report.pitch_rad};
}

}  // namespace

TEST_CASE("a mount that is right agrees, level or tilted", "[ground][mount_check]") {
  for (const Mount& mount :
       {Mount{}, Mount{.height_m = 0.6}, Mount{.height_m = 2.4, .pitch_rad = 10.0 * kDegree},
        Mount{.roll_rad = -10.0 * kDegree, .yaw_rad = 1.0}}) {
    const MountReport report = check(mount, mount);
    CHECK(report.finding == MountFinding::kAgrees);
    CHECK(report.num_sweeps == 5);
    CHECK(report.height_m == Approx(mount.height_m).margin(0.02));
    CHECK(to_text(report, mount).empty());
  }
}

TEST_CASE("a wrong height is reported with the right one", "[ground][mount_check]") {
  for (const double height_m : {1.2, 2.2, 3.0}) {
    const MountReport report = check({.height_m = height_m}, Mount{});
    CHECK(report.finding == MountFinding::kWrongHeight);
    CHECK(report.height_m == Approx(height_m).margin(0.03));
    CHECK_THAT(to_text(report, Mount{}), Contains("mount.height_m is 1.73"));
  }
}

TEST_CASE("a tilt that the mount does not know is reported, and the estimate mends it",
          "[ground][mount_check]") {
  const Mount real{.height_m = 1.73, .roll_rad = -4.0 * kDegree, .pitch_rad = 10.0 * kDegree};
  const MountReport report = check(real, Mount{});
  CHECK(report.finding == MountFinding::kTilted);
  CHECK(report.roll_rad == Approx(real.roll_rad).margin(0.01));
  CHECK(report.pitch_rad == Approx(real.pitch_rad).margin(0.01));
  CHECK(check(real, estimate(report)).finding == MountFinding::kAgrees);
}

TEST_CASE("a sensor upside down is noticed unless the mount says so", "[ground][mount_check]") {
  const Mount inverted{.height_m = 1.73, .roll_rad = std::numbers::pi};
  for (const Scene& scene : {street_with_cars(), Scene().level_ground()}) {
    const MountReport report = check(inverted, Mount{}, scene);
    CHECK(report.is_warning());
    CHECK_THAT(to_text(report, Mount{}), Contains("upside down") && Contains("mount.roll_rad=3.14"));
    const MountReport unseen = check(inverted, inverted, scene);
    CHECK(unseen.finding == MountFinding::kUnseen);
    CHECK_FALSE(unseen.is_warning());
    CHECK_THAT(to_text(unseen, inverted), Contains("could not be checked"));
  }
}

TEST_CASE("points whose z axis looks down are noticed, and the estimate mends them",
          "[ground][mount_check]") {
  const Mount inverted{.roll_rad = std::numbers::pi};
  const MountReport report = check(Mount{}, inverted);
  CHECK(report.finding == MountFinding::kUpsideDown);
  CHECK(check(Mount{}, estimate(report)).finding == MountFinding::kAgrees);
}

TEST_CASE("a mount that has the sensor on its side is noticed, and the estimate mends it",
          "[ground][mount_check]") {
  for (const double angle_deg : {-90.0, -70.0, 70.0, 90.0}) {
    for (const Mount& believed :
         {Mount{.roll_rad = angle_deg * kDegree}, Mount{.pitch_rad = angle_deg * kDegree}}) {
      INFO("roll " << believed.roll_rad << ", pitch " << believed.pitch_rad);
      const MountReport report = check(Mount{}, believed);
      CHECK(report.finding == MountFinding::kRotated);
      CHECK(report.roll_rad == Approx(0.0).margin(0.02));
      CHECK(report.pitch_rad == Approx(0.0).margin(0.02));
      CHECK_THAT(to_text(report, believed), Contains("mount.height_m=1.7"));
      CHECK(check(Mount{}, estimate(report)).finding == MountFinding::kAgrees);
    }
  }
}

TEST_CASE("axes in another order are noticed, and the estimate mends them", "[ground][mount_check]") {
  Sweep sweep(kMaxReturns);
  GroundConfig config;
  config.mount_check.sweeps = 1;
  // A camera's: x right, y down, z forward.
  const auto as_camera = [&] {
    street_with_cars().scan(sweep, {.noise_m = 0.02});
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
      sweep.x_m[i] = -y, sweep.y_m[i] = -z, sweep.z_m[i] = x;
    }
  };
  const auto report_for = [&](const Mount& believed) {
    as_camera();
    GroundStage stage(config, believed, sweep.capacity());
    stage.begin(sweep);
    stage.finish(sweep);
    return stage.mount_report();
  };
  const MountReport report = report_for(Mount{});
  CHECK(report.finding == MountFinding::kRotated);
  CHECK_THAT(to_text(report, Mount{}), Contains("x forward, y left, z up"));
  CHECK(report_for(estimate(report)).finding == MountFinding::kAgrees);
}

TEST_CASE("no plane, no ground", "[ground][mount_check]") {
  Scene clutter;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-15.0, 15.0), size(0.05, 0.4);
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d at(place(random), place(random), 0.1 * place(random)),
        half(size(random), size(random), size(random));
    clutter.box(at - half, at + half);
  }
  const MountReport report = check(Mount{}, Mount{}, clutter);
  CHECK(report.finding == MountFinding::kNoGround);
  CHECK_THAT(to_text(report, Mount{}), Contains("no ground"));
}

TEST_CASE("the end of a short recording concludes what was seen", "[ground][mount_check]") {
  Sweep sweep(kMaxReturns);
  for (const double believed_m : {1.73, 1.0}) {
    GroundStage stage({}, Mount{.height_m = believed_m}, sweep.capacity());
    CHECK(stage.mount_report().concluded().finding == MountFinding::kPending);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      street_with_cars().scan(sweep, {.noise_m = 0.02, .seed = seed});
      stage.begin(sweep);
      stage.finish(sweep);
    }
    CHECK(stage.mount_report().finding == MountFinding::kPending);
    const MountReport report = stage.mount_report().concluded();
    CHECK(report.finding == (believed_m == 1.73 ? MountFinding::kAgrees : MountFinding::kWrongHeight));
    CHECK(report.num_sweeps == 3);
    CHECK(report.height_m == Approx(1.73).margin(0.03));
  }
}

TEST_CASE("an estimate of the height changes nothing of what the check expects", "[ground][mount_check]") {
  // Upside down, with a low ledge beside it: by itself that is a ground 0.6 m below the sensor.
  const Mount inverted{.roll_rad = std::numbers::pi};
  Sweep sweep(kMaxReturns);
  GroundConfig config;
  config.mount_check.sweeps = 1;
  config.height.enabled = true;
  Scene().level_ground().box({-30, -30, 2.3}, {30, 30, 2.6}).scan(sweep, {.mount = inverted});
  const auto stage_with = [&](double height_m) {
    GroundStage stage(config, Mount{.height_m = height_m}, sweep.capacity());
    stage.begin(sweep);
    stage.finish(sweep);
    return stage;
  };
  const GroundStage near_by = stage_with(1.0), far_off = stage_with(1.73);
  CHECK(near_by.height_m() == Approx(0.57).margin(0.05));
  CHECK(near_by.mount_report().is_warning());
  CHECK(far_off.height_m() == 1.73);
  CHECK(far_off.mount_report().is_warning());
}

TEST_CASE("returns are sampled from every laser, whatever the size of the sweep", "[ground][mount_check]") {
  GroundConfig config;
  config.mount_check.sweeps = 1;
  for (const std::uint32_t size : {100'000U, 128'000U, 200'000U}) {
    Sweep sweep(size);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-10.0F, 10.0F);
    for (std::uint32_t i = 0; i < size; ++i) {
      // Of the first laser of either block nothing but a far wall is seen.
      const bool is_wall = i % 32 == 0;
      sweep.x_m[i] = is_wall ? 60.0F : place(random);
      sweep.y_m[i] = place(random);
      sweep.z_m[i] = is_wall ? place(random) : -1.73F;
    }
    sweep.size = size;
    GroundStage stage(config, Mount{}, size);
    stage.begin(sweep);
    stage.finish(sweep);
    CHECK(stage.mount_report().finding == MountFinding::kAgrees);
  }
}

TEST_CASE("sweeps that are not whole say nothing, and the check can be switched off",
          "[ground][mount_check]") {
  Sweep sweep(kMaxReturns);
  street_with_cars().scan(sweep);
  GroundConfig config;
  config.mount_check.sweeps = 1;
  GroundStage stage(config, Mount{}, sweep.capacity());
  for (const std::uint32_t flag : {kPartialStart, kPartialEnd, kIncomplete, kSuperseded}) {
    sweep.header.flags = flag;
    stage.begin(sweep);
    stage.finish(sweep);
    CHECK(stage.mount_report().finding == MountFinding::kPending);
  }
  sweep.header.flags = 0;
  config.mount_check.enabled = false;
  GroundStage unchecked(config, Mount{.height_m = 9.0}, sweep.capacity());
  unchecked.begin(sweep);
  unchecked.finish(sweep);
  CHECK(unchecked.mount_report().finding == MountFinding::kPending);
}

TEST_CASE("the check and the estimate touch no heap", "[ground][mount_check]") {
  Sweep sweep(kMaxReturns);
  street_with_cars().scan(sweep);
  GroundConfig config;
  config.mount_check.sweeps = 2;
  config.height.enabled = true;
  GroundStage stage(config, Mount{}, sweep.capacity());
  const AllocationGuard guard;
  for (int i = 0; i < 3; ++i) {
    stage.begin(sweep);
    stage.accept({&sweep, sweep.size, sweep.header.num_columns, true});
    stage.finish(sweep);
  }
  CHECK(guard.count() == 0);
  CHECK(stage.mount_report().finding == MountFinding::kAgrees);
}

TEST_CASE("KITTI's car carries its sensor as the default mount says", "[ground][mount_check]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  for (const double believed_m : {1.73, 1.2}) {
    GroundStage stage({}, Mount{.height_m = believed_m}, 300'000);
    RecordedSweeps sweeps(folder / "drive_0005.pcap", folder / "calibration.yaml");
    while (stage.mount_report().finding == MountFinding::kPending) {
      Sweep* sweep = sweeps.next();
      REQUIRE(sweep != nullptr);
      stage.begin(*sweep);
      stage.finish(*sweep);
    }
    CHECK(stage.mount_report().height_m == Approx(1.73).margin(0.08));
    CHECK(stage.mount_report().finding ==
          (believed_m == 1.73 ? MountFinding::kAgrees : MountFinding::kWrongHeight));
  }
}
