// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "src/ground/adaptive_bounds.hpp"
#include "src/ground/wall_removal.hpp"
#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::ground;
using namespace pago::test;

namespace {

GroundConfig plus() {
  GroundConfig config;
  config.method = "patchworkpp";
  return config;
}

}  // namespace

TEST_CASE("the learnt height follows the ground, within its limit", "[ground][patchworkpp]") {
  const PatchworkppConfig config;
  AdaptiveBounds bounds(config, 1.73);
  CHECK(bounds.height_m() == 1.73);
  for (int sweep = 0; sweep < 50; ++sweep) {
    for (int k = 0; k < 20; ++k) bounds.note(0, -1.6, 1e-4);
    bounds.learn();
  }
  CHECK(bounds.height_m() == Approx(1.6));
  for (int sweep = 0; sweep < 500; ++sweep) {
    for (int k = 0; k < 20; ++k) bounds.note(0, -0.7, 1e-4);  // a boat's deck: issue #41 of the authors' code
    bounds.learn();
  }
  CHECK(bounds.height_m() == Approx(1.73 - config.max_height_change_m));
  bounds.reset(1.73);
  CHECK(bounds.height_m() == 1.73);
}

TEST_CASE("bounds are means and deviations of the latest planes alone", "[ground][patchworkpp]") {
  PatchworkppConfig config;
  config.memory = 4;
  AdaptiveBounds bounds(config, 1.73);
  for (const double z : {-9.0, -9.0, -1.8, -1.6, -1.8, -1.6}) bounds.note(1, z, 1e-3);
  bounds.learn();
  const double deviation = std::sqrt(0.04 / 3.0);  // of the last four, sample
  CHECK(bounds.max_z_m(1) == Approx(-1.7 + 2.0 * deviation));
  CHECK(bounds.max_flatness_m2(1) == Approx(1e-3));
  CHECK(bounds.max_flatness_m2(2) == 0.0);  // nothing noted, nothing learnt
}

TEST_CASE("the bounds on elevation begin at the mount's ground and never leave its neighbourhood",
          "[ground][patchworkpp]") {
  const PatchworkppConfig config;
  for (const double height_m : {0.8, 1.73, 3.0}) {
    AdaptiveBounds bounds(config, height_m);
    for (int ring = 0; ring < AdaptiveBounds::kRings; ++ring)
      CHECK(bounds.max_z_m(ring) == Approx(config.max_elevation_m - height_m));
    // Planes just below the bound raise it, sweep by sweep: with a spread of their own, without end.
    for (int sweep = 0; sweep < 200; ++sweep) {
      for (int ring = 0; ring < AdaptiveBounds::kRings; ++ring)
        for (int k = 0; k < 20; ++k)
          bounds.note(ring, bounds.max_z_m(ring) - (k % 2 == 0 ? 0.01 : 0.5), 1e-4);
      bounds.learn();
      for (int ring = 0; ring < AdaptiveBounds::kRings; ++ring)
        CHECK(bounds.max_z_m(ring) <= config.max_elevation_m - height_m + 1e-9);
    }
    for (int sweep = 0; sweep < 100; ++sweep) {
      for (int k = 0; k < 20; ++k) bounds.note(2, -20.0, 1e-4);  // a bridge's side: the road below it
      bounds.learn();
    }
    CHECK(bounds.max_z_m(2) == Approx(-height_m - config.max_elevation_m));
    bounds.reset(height_m);
    CHECK(bounds.max_z_m(2) == Approx(config.max_elevation_m - height_m));
  }
}

TEST_CASE("Patchwork++ finds the ground of a sensor lower than its mount says, and not beyond the limit",
          "[ground][patchworkpp]") {
  Sweep sweep(kMaxReturns);
  const auto truth = Scene().level_ground().scan(sweep, {.mount = {.height_m = 1.6}, .noise_m = 0.01});
  const auto segmenter = make_segmenter(plus(), Mount{}, sweep.capacity());
  for (int i = 0; i < 10; ++i) segment(*segmenter, sweep);
  const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
  CHECK(share_called_ground(mask_of(sweep), truth, kGround, near) > 0.99);
}

TEST_CASE("what it has learnt changes the mask of a later sweep, and a reset undoes that",
          "[ground][patchworkpp]") {
  Sweep sweep(kMaxReturns), low(kMaxReturns);
  // A loading platform beside the road: 1.2 m up, flat, too high once the road's own height is known.
  Scene().level_ground().box({-9, 3, 0}, {9, 9, 1.2}, kGround).scan(sweep, {.noise_m = 0.03});
  Scene().level_ground().scan(low, {.noise_m = 0.002});
  const auto segmenter = make_segmenter(plus(), Mount{}, sweep.capacity());
  segment(*segmenter, sweep);
  const auto at_first = mask_of(sweep);
  segmenter->reset();
  for (int i = 0; i < 5; ++i) segment(*segmenter, low);
  segment(*segmenter, sweep);
  CHECK(mask_of(sweep) != at_first);
  segmenter->reset();
  segment(*segmenter, sweep);
  CHECK(mask_of(sweep) == at_first);
}

TEST_CASE("dark returns deep under the near ground are mirror images, bright or far ones are not",
          "[ground][patchworkpp]") {
  Sweep sweep(kMaxReturns);
  Scene().level_ground().scan(sweep);
  const std::uint32_t victim = static_cast<std::uint32_t>(sweep.range_image.at(20, 500));
  const auto verdict = [&](std::uint8_t intensity) {
    sweep.z_m[victim] = -2.7F;
    sweep.intensity[victim] = intensity;
    return segmented(plus(), sweep)[victim];
  };
  CHECK(verdict(20) == kNonGround);
  CHECK(verdict(120) == kGround);
}

TEST_CASE("walls are taken out of a bin one after the other, and ground is left", "[ground][wall_removal]") {
  std::vector<float> x, y, z;
  const auto add = [&](double px, double py, double pz) {
    x.push_back(static_cast<float>(px));
    y.push_back(static_cast<float>(py));
    z.push_back(static_cast<float>(pz));
  };
  for (int i = 0; i < 200; ++i) add(0.02 * i, 0.0, -1.73 + 0.003 * (i % 80));  // a wall's foot, the lowest
  const std::size_t wall = x.size();
  for (int i = 0; i < 400; ++i) add(0.1 * (i % 20), 1.0 + 0.1 * (i / 20), -1.3);
  WallRemoval remove({}, 1000);
  FixedVector<Slab> walls(10);
  const Points rest = remove({x, y, z}, -1e9F, 1.0F, 1.0F, walls);
  CHECK(walls.size() == 1);
  CHECK(rest.size() == x.size() - wall);
  walls.clear();
  const Points again =
      remove({std::span(x).subspan(wall), std::span(y).subspan(wall), std::span(z).subspan(wall)}, -1e9F,
             1.0F, 1.0F, walls);
  CHECK(walls.empty());
  CHECK(again.size() == x.size() - wall);
}
