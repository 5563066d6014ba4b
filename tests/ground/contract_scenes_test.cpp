// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What every ground method must see in simple worlds. Walks the table: a new row is tested by being there.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

namespace {

std::vector<std::uint8_t> scan_and_segment(const GroundCase& c,
                                           const Scene& scene,
                                           Sweep& sweep,
                                           std::vector<std::uint8_t>& truth) {
  truth = scene.scan(sweep, kNoisy);
  return segmented(c.config, sweep);
}

std::vector<GroundCase> finders() {
  std::vector<GroundCase> cases = ground_cases();
  std::erase_if(cases, [](const GroundCase& c) { return !c.can.finds_ground; });
  return cases;
}

}  // namespace

TEST_CASE("every method finds level ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground(), sweep, truth);
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 30.0; };
    CHECK(share_called_ground(mask, truth, kGround, near) >= c.can.min_recall);
  }
}

TEST_CASE("every method finds a ramp ahead, as steep as it can follow", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const double grade : {-0.05, 0.05, 0.10, 0.15, 0.20}) {
    for (const GroundCase& c : finders()) {
      if (std::abs(grade) > c.can.max_ramp) continue;
      INFO(c.name << ", grade " << grade);
      const auto mask = scan_and_segment(c, Scene().ramp(grade, 15.0), sweep, truth);
      // LeGO-LOAM looks at no higher rings.
      const auto on_ramp = [&](std::size_t i) {
        return sweep.x_m[i] > 15.0F && range_xy_m(sweep, i) < 30.0 && sweep.ring[i] <= 50;
      };
      CHECK(share_called_ground(mask, truth, kGround, on_ramp) >=
            (grade > 0.0 ? c.can.min_ramp_recall : c.can.min_fall_recall));
    }
  }
}

TEST_CASE("methods of one plane find the whole world aslant, up to 20 %", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const double grade : {0.10, 0.20}) {
    for (const GroundCase& c : finders()) {
      if (c.can.max_ramp > 0.0) continue;
      INFO(c.name << ", grade " << grade);
      const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 30.0; };
      const auto ahead = scan_and_segment(c, Scene().ground(grade), sweep, truth);
      CHECK(share_called_ground(ahead, truth, kGround, near) >= c.can.min_recall);
      const auto across = scan_and_segment(c, Scene().ground(0.0, grade), sweep, truth);
      CHECK(share_called_ground(across, truth, kGround, near) >= c.can.min_recall);
    }
  }
}

TEST_CASE("every method takes both sides of a kerb for ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask =
        scan_and_segment(c, Scene().level_ground().box({-60, 4, -1}, {60, 12, 0.15}, kGround), sweep, truth);
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, near) >= c.can.min_recall);
  }
}

TEST_CASE("methods take a wall for ground no more than they must", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground().box({-40, 8, 0}, {40, 9, 5}), sweep, truth);
    const auto upper = [&](std::size_t i) { return sweep.z_m[i] > -1.3F; };
    CHECK(share_called_ground(mask, truth, kNonGround, upper) < c.can.max_wall);
    const auto before = [&](std::size_t i) { return sweep.y_m[i] < 7.0F && range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, before) >= c.can.min_recall);
  }
}

TEST_CASE("no method takes the sides of a car for ground, and all see the road around it",
          "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, Scene().level_ground().box({8, -1, 0}, {12, 1, 1.5}), sweep, truth);
    const auto side = [&](std::size_t i) { return sweep.z_m[i] > -1.3F && sweep.z_m[i] < -0.3F; };
    CHECK(share_called_ground(mask, truth, kNonGround, side) < 0.02);
    const auto road = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, road) >= c.can.min_recall);
  }
}

TEST_CASE("methods that know height take the roof of a near car for no ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask =
        scan_and_segment(c, Scene().level_ground().box({4, -1.5, 0}, {7.4, 1.5, 1.4}), sweep, truth);
    const auto roof = [&](std::size_t i) { return sweep.z_m[i] > -0.4F; };
    CHECK(share_called_ground(mask, truth, kNonGround, roof) <= c.can.max_roof);
  }
}

TEST_CASE("methods see a bridge overhead as no ground, and find the road below", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  const Scene scene = Scene().level_ground().box({20, -30, 2.0}, {40, 30, 3.0});
  for (const GroundCase& c : finders()) {
    INFO(c.name);
    const auto mask = scan_and_segment(c, scene, sweep, truth);
    const auto all = [](std::size_t) { return true; };
    CHECK(share_called_ground(mask, truth, kNonGround, all) < c.can.max_bridge);
    const auto below = [&](std::size_t i) { return sweep.x_m[i] > 20.0F && range_xy_m(sweep, i) < 30.0; };
    CHECK(share_called_ground(mask, truth, kGround, below) >= c.can.min_below_bridge);
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
  for (const GroundCase& c : finders()) {
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
    CHECK(share_called_ground(mask, truth, kGround, near) >= c.can.min_tilted_recall);
    const auto upper = [&](std::size_t i) { return height_m(i) > 0.5; };
    CHECK(share_called_ground(mask, truth, kNonGround, upper) < std::max(0.01, c.can.max_wall));
  }
}
