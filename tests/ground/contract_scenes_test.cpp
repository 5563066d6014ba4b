// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What every ground method must see in simple worlds. Walks the table: a new row is tested by being there.
#include <numbers>

#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr ScanOptions kNoisy{.mount = {}, .columns = 2083, .noise_m = 0.01, .seed = 5, .max_range_m = 120.0};

std::vector<std::uint8_t> scan_and_segment(const GroundCase& c,
                                           const Scene& scene,
                                           Sweep& sweep,
                                           std::vector<std::uint8_t>& truth) {
  truth = scene.scan(sweep, kNoisy);
  return segmented(c.config, sweep);
}

}  // namespace

TEST_CASE("every method finds level ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground(), sweep, truth);
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 30.0; };
    CHECK(share_called_ground(mask, truth, kGround, near) > c.min_recall);
  }
}

TEST_CASE("every method finds a ramp of up to 15 % ahead", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const double grade : {0.10, 0.15, -0.10}) {
    for (const GroundCase& c : ground_cases()) {
      INFO(c.name << ", grade " << grade);
      const auto mask = scan_and_segment(c, Scene().ramp(grade, 15.0), sweep, truth);
      // LeGO-LOAM looks at no higher rings.
      const auto on_ramp = [&](std::size_t i) {
        return sweep.x_m[i] > 15.0F && range_xy_m(sweep, i) < 30.0 && sweep.ring[i] <= 50;
      };
      CHECK(share_called_ground(mask, truth, kGround, on_ramp) > c.min_recall);
    }
  }
}

TEST_CASE("every method takes both sides of a kerb for ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto mask =
        scan_and_segment(c, Scene().level_ground().box({-60, 4, -1}, {60, 12, 0.15}, kGround), sweep, truth);
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, near) > c.min_recall);
  }
}

TEST_CASE("no method takes a wall for ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground().box({-40, 8, 0}, {40, 9, 5}), sweep, truth);
    const auto upper = [&](std::size_t i) { return sweep.z_m[i] > -1.3F; };
    CHECK(share_called_ground(mask, truth, kNonGround, upper) < 0.01);
    const auto before = [&](std::size_t i) { return sweep.y_m[i] < 7.0F && range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, before) > c.min_recall);
  }
}

TEST_CASE("no method takes the sides of a car for ground, and all see the road around it",
          "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground().box({8, -1, 0}, {12, 1, 1.5}), sweep, truth);
    const auto side = [&](std::size_t i) { return sweep.z_m[i] > -1.3F && sweep.z_m[i] < -0.3F; };
    CHECK(share_called_ground(mask, truth, kNonGround, side) < 0.02);
    const auto road = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, road) > c.min_recall);
  }
}

TEST_CASE("no method takes a bridge overhead for ground, and all find the road below", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  const Scene scene = Scene().level_ground().box({20, -30, 2.0}, {40, 30, 3.0});
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, scene, sweep, truth);
    const auto all = [](std::size_t) { return true; };
    CHECK(share_called_ground(mask, truth, kNonGround, all) < 0.05);
    const auto below = [&](std::size_t i) { return sweep.x_m[i] > 20.0F && range_xy_m(sweep, i) < 30.0; };
    CHECK(share_called_ground(mask, truth, kGround, below) > c.min_recall);
  }
}

TEST_CASE("every method judges in the vehicle's frame, not in a tilted sensor's", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  Mount tilted;
  tilted.pitch_rad = 12.0 * std::numbers::pi / 180.0;
  tilted.roll_rad = -5.0 * std::numbers::pi / 180.0;
  ScanOptions options = kNoisy;
  options.mount = tilted;
  const Scene scene = Scene().level_ground().box({-40, 8, 0}, {40, 9, 5});
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto truth = scene.scan(sweep, options);
    const auto mask = segmented(c.config, sweep, tilted);
    const Eigen::Matrix3d R = tilted.R_level_sensor();
    const auto height_m = [&](std::size_t i) {
      return R.row(2).dot(Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>()) +
             tilted.height_m;
    };
    // Ahead the sensor looks down more steeply; rings that LeGO-LOAM's tests never reach look at the ground.
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 15.0 && sweep.ring[i] < 50; };
    CHECK(share_called_ground(mask, truth, kGround, near) > c.min_recall);
    const auto upper = [&](std::size_t i) { return height_m(i) > 0.5; };
    CHECK(share_called_ground(mask, truth, kNonGround, upper) < 0.01);
  }
}
