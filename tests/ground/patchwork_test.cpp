// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

namespace {

GroundConfig patchwork() {
  return {};  // the default method
}

/// `n` returns spread over a 1 m patch around (x, y), at this height above the ground.
void add_patch(Sweep& sweep, int n, float x, float y, float height_m) {
  for (int k = 0; k < n; ++k) {
    const int place = 37 * k % 100;
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = x + 0.1F * static_cast<float>(place % 10) - 0.5F;
    sweep.y_m[i] = y + 0.1F * static_cast<float>(place / 10) - 0.5F;
    sweep.z_m[i] = height_m - 1.73F;
  }
}

long count_ground(const GroundConfig& config, Sweep& sweep) {
  const auto mask = segmented(config, sweep);
  return std::count(mask.begin(), mask.end(), kGround);
}

}  // namespace

TEST_CASE("the bound on elevation is that of each ring", "[ground][patchwork]") {
  Sweep sweep(1000);
  const auto is_ground = [&](float x, float height_m, const GroundConfig& config) {
    sweep.reset();
    add_patch(sweep, 100, x, 2.0F, height_m);
    return count_ground(config, sweep) > 0;
  };
  const GroundConfig paper = patchwork();
  // Rings 0 to 3 begin at 2.7, 7.53, 12.36 and 14.78 m.
  CHECK(is_ground(5.0F, 0.50F, paper));
  CHECK_FALSE(is_ground(5.0F, 0.55F, paper));
  CHECK(is_ground(9.8F, 0.70F, paper));
  CHECK(is_ground(13.5F, 0.85F, paper));
  CHECK(is_ground(15.9F, 1.10F, paper));
  CHECK_FALSE(is_ground(5.0F, 1.10F, paper));
  CHECK(is_ground(30.0F, 5.0F, paper));
  GroundConfig bounded = paper;
  bounded.patchwork.max_elevation_beyond_m = 3.0;
  CHECK_FALSE(is_ground(30.0F, 5.0F, bounded));
  CHECK(is_ground(30.0F, 2.5F, bounded));
}

TEST_CASE("an elevated plane is ground after all where it is flat enough for its ring",
          "[ground][patchwork]") {
  Sweep sweep(1000);
  // Perfectly flat, 2 m up: flatter than the bound of ring 1, but ring 0 forgives nothing.
  add_patch(sweep, 100, 9.8F, 2.0F, 2.0F);
  CHECK(count_ground(patchwork(), sweep) == 100);
  sweep.reset();
  add_patch(sweep, 100, 5.0F, 2.0F, 2.0F);
  CHECK(count_ground(patchwork(), sweep) == 0);
}

TEST_CASE("a bin needs more returns than min_points", "[ground][patchwork]") {
  Sweep sweep(1000);
  add_patch(sweep, 10, 25.0F, 2.0F, 0.0F);
  CHECK(count_ground(patchwork(), sweep) == 0);
  add_patch(sweep, 1, 25.5F, 2.2F, 0.0F);
  CHECK(count_ground(patchwork(), sweep) == 11);
}

TEST_CASE("returns far below the ground are non-ground and pull no plane down", "[ground][patchwork]") {
  Sweep sweep(1000);
  add_patch(sweep, 100, 25.0F, 2.0F, 0.0F);
  add_patch(sweep, 30, 25.0F, 2.0F, -2.5F);
  const auto mask = segmented(patchwork(), sweep);
  CHECK(std::count(mask.begin(), mask.begin() + 100, kGround) == 100);
  CHECK(std::count(mask.begin() + 100, mask.end(), kGround) == 0);
}

TEST_CASE("everything below the plane is ground too", "[ground][patchwork]") {
  Sweep sweep(1000);
  add_patch(sweep, 200, 25.0F, 2.0F, 0.0F);
  add_patch(sweep, 5, 25.0F, 2.0F, -0.4F);
  CHECK(count_ground(patchwork(), sweep) == 205);
}

TEST_CASE("in the first zone, mirror images just under the ground do not set the height",
          "[ground][patchwork]") {
  Sweep sweep(1000);
  add_patch(sweep, 200, 5.5F, 1.2F, 0.0F);
  add_patch(sweep, 25, 5.5F, 1.2F, -0.6F);
  CHECK(count_ground(patchwork(), sweep) == 225);
}

TEST_CASE("the vehicle itself and what is beyond 80 m are non-ground", "[ground][patchwork]") {
  Sweep sweep(1000);
  add_patch(sweep, 100, 0.0F, 0.0F, 0.0F);
  add_patch(sweep, 100, 85.0F, 0.0F, 0.0F);
  CHECK(count_ground(patchwork(), sweep) == 0);
}

TEST_CASE("Patchwork looks for the ground at the mount's height", "[ground][patchwork]") {
  Sweep sweep(kMaxReturns);
  const Mount high{.height_m = 3.0};
  const auto truth = Scene().level_ground().scan(sweep, {.mount = high, .noise_m = 0.01});
  const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
  CHECK(share_called_ground(segmented(patchwork(), sweep, high), truth, kGround, near) > 0.99);
  // Seen as 1.3 m under the ground of a low mount, whose bound in the near rings it cannot pass; no harm
  // done.
  CHECK(share_called_ground(segmented(patchwork(), sweep, Mount{.height_m = 1.73}), truth, kGround, near) >
        0.9);
}

TEST_CASE("Patchwork refuses zones that cannot be", "[ground][patchwork]") {
  const auto refuses = [](auto change) {
    GroundConfig config = patchwork();
    change(config.patchwork);
    CHECK_THROWS_AS(ground::make_segmenter(config, Mount{}, 100), Error);
  };
  refuses([](PatchworkConfig& c) { c.zone_rings[1] = 2.5; });
  refuses([](PatchworkConfig& c) { c.zone_sectors[3] = 31.7; });
  refuses([](PatchworkConfig& c) { c.min_range_m = c.max_range_m; });
  refuses([](PatchworkConfig& c) {
    c.zone_rings.fill(64);
    c.zone_sectors.fill(360);
  });
}
