// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/height_estimate.hpp"

#include <algorithm>
#include <vector>

#include "pago/ground/ground_stage.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/kitti_scan.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::ground;
using namespace pago::test;

namespace {

std::optional<double> estimated(const Sweep& sweep, const Mount& mount = {}) {
  return HeightEstimate({}, mount, sweep.capacity())(sweep);
}

GroundConfig with_estimate() {
  GroundConfig config;
  config.height.enabled = true;
  return config;
}

}  // namespace

TEST_CASE("most values agree, outliers have no say", "[ground][consensus]") {
  std::vector<BoundedValue> values;
  for (const double v : {-1.71, -1.73, -1.72, -1.74, -0.4, 0.3, -2.9}) values.push_back({v, 0.05, 1.0});
  CHECK(consensus(values).count == 4);
  CHECK(consensus(values).value == Approx(-1.725).margin(1e-9));
  values[0].weight = 3.0;
  CHECK(consensus(values).value == Approx((3 * -1.71 - 1.73 - 1.72 - 1.74) / 6.0).margin(1e-9));
}

TEST_CASE("one value agrees with itself, none with nothing", "[ground][consensus]") {
  CHECK(consensus({}).count == 0);
  const std::vector<BoundedValue> one{{-1.5, 0.1, 2.0}};
  CHECK(consensus(one).value == Approx(-1.5));
  CHECK(consensus(one).count == 1);
}

TEST_CASE("the order of values does not matter", "[ground][consensus]") {
  std::vector<BoundedValue> values;
  for (int i = 0; i < 20; ++i) values.push_back({-1.7 + 0.01 * ((7 * i) % 20), 0.03 + 0.001 * i, 1.0 + i});
  const double first = consensus(values).value;
  std::reverse(values.begin(), values.end());
  CHECK(consensus(values).value == Approx(first).margin(1e-12));
}

TEST_CASE("the height is estimated from what is near, cars and walls about", "[ground][height]") {
  Sweep sweep(kMaxReturns);
  const Scene scene = Scene().level_ground().box({3.2, -4, 0}, {6, -2.5, 1.4}).box({-20, 4, 0}, {20, 5, 6});
  for (const double height_m : {1.0, 1.73, 2.3, 4.0, 6.0}) {
    scene.scan(sweep, {.mount = {.height_m = height_m}, .noise_m = 0.02});
    const auto found = estimated(sweep);
    REQUIRE(found.has_value());
    CHECK(*found == Approx(height_m).margin(0.05));
  }
}

TEST_CASE("a tilted mount that is known does not tilt the estimate", "[ground][height]") {
  Sweep sweep(kMaxReturns);
  const Mount tilted{.height_m = 1.9, .pitch_rad = 0.17};
  Scene().level_ground().scan(sweep, {.mount = tilted, .noise_m = 0.02});
  CHECK(*estimated(sweep, tilted) == Approx(1.9).margin(0.05));
}

TEST_CASE("without ground there is no estimate", "[ground][height]") {
  Sweep sweep(kMaxReturns);
  Scene().box({8, -20, -5}, {9, 20, 5}).scan(sweep);
  CHECK_FALSE(estimated(sweep).has_value());
  sweep.size = 0;
  CHECK_FALSE(estimated(sweep).has_value());
}

TEST_CASE("KITTI's sensor is 1.73 m up", "[ground][height]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/odometry_00_000000-000015");
  Sweep sweep(kMaxReturns);
  for (const auto& file : kitti_scans(folder / "velodyne")) {
    load_kitti_points(file, sweep);
    CHECK(estimated(sweep).value_or(0.0) == Approx(1.73).margin(0.1));
  }
}

TEST_CASE("with the estimate a stage works as if the mount were right", "[ground][height]") {
  Sweep sweep(kMaxReturns);
  const Scene scene = Scene().level_ground().box({4, -1.5, 0}, {7.4, 1.5, 1.4});
  scene.scan(sweep, {.mount = {.height_m = 2.6}, .noise_m = 0.02});
  GroundStage stage(with_estimate(), Mount{}, sweep.capacity());
  CHECK(stage.height_m() == 1.73);
  stage.begin(sweep);
  stage.accept({&sweep, sweep.size / 2, sweep.header.num_columns / 2 - 10, false});
  stage.finish(sweep);
  const double height_m = stage.height_m();
  CHECK(height_m == Approx(2.6).margin(0.05));
  const auto mask = mask_of(sweep);
  CHECK(mask == segmented({}, sweep, {.height_m = height_m}));

  // Found once, it stays.
  Scene().level_ground().scan(sweep, {.mount = {.height_m = 2.2}, .noise_m = 0.02});
  stage.begin(sweep);
  stage.finish(sweep);
  CHECK(stage.height_m() == height_m);
}

TEST_CASE("a part of a sweep is not estimated from, and what the estimate is comes into the report",
          "[ground][height]") {
  Sweep sweep(kMaxReturns);
  GroundStage stage(with_estimate(), Mount{}, sweep.capacity());
  for (const unsigned flag : {0U + kPartialStart, 0U + kPartialEnd, 0U + kIncomplete, 0U + kSuperseded, 0U}) {
    CHECK(stage.height_m() == 1.73);
    CHECK(stage.mount_report().set_height_m == 0.0);
    CHECK(height_line(stage.mount_report(), Mount{}).empty());
    Scene().level_ground().scan(sweep, {.mount = {.height_m = 2.2}, .noise_m = 0.02});
    sweep.header.flags = flag;
    stage.begin(sweep);
    stage.finish(sweep);
  }
  CHECK(stage.height_m() == Approx(2.2).margin(0.05));
  CHECK(stage.mount_report().set_height_m == stage.height_m());
  CHECK_THAT(height_line(stage.mount_report(), Mount{}),
             Catch::Contains("height    2.2") && Catch::Contains("mount.height_m is 1.73"));
}

TEST_CASE("while no sweep shows ground the mount's height holds", "[ground][height]") {
  Sweep sweep(kMaxReturns);
  Scene().box({8, -20, -5}, {9, 20, 5}).scan(sweep);
  GroundStage stage(with_estimate(), Mount{.height_m = 2.0}, sweep.capacity());
  stage.begin(sweep);
  stage.finish(sweep);
  CHECK(stage.height_m() == 2.0);
  Scene().level_ground().scan(sweep, {.mount = {.height_m = 1.5}});
  stage.begin(sweep);
  stage.finish(sweep);
  CHECK(stage.height_m() == Approx(1.5).margin(0.02));
}
