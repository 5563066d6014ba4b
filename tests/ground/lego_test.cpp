// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

namespace {

GroundConfig lego(LegoConfig::Projection projection) {
  GroundConfig config;
  config.method = "lego";
  config.lego.projection = projection;
  return config;
}

}  // namespace

TEST_CASE("the ring projection tests each laser against the next, and no pair above ground_rings",
          "[ground][lego]") {
  Sweep sweep(kMaxReturns);
  GroundConfig config = lego(LegoConfig::Projection::kRing);
  Scene().level_ground().scan(sweep);
  const auto mask = segmented(config, sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    REQUIRE(mask[i] == (sweep.ring[i] <= 50 ? kGround : kNonGround));
  config.lego.ground_rings = 10;
  const auto low = segmented(config, sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    REQUIRE(low[i] == (sweep.ring[i] <= 10 ? kGround : kNonGround));
}

TEST_CASE("with the ring projection a hole in the ground spares its neighbours", "[ground][lego]") {
  Sweep sweep(kMaxReturns);
  Scene().level_ground().scan(sweep);
  for (int column = 0; column < 2083; ++column) sweep.range_image.at(20, column) = RangeImage::kEmpty;
  const auto mask = segmented(lego(LegoConfig::Projection::kRing), sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const bool is_ground = sweep.ring[i] != 20 && sweep.ring[i] <= 50;
    REQUIRE(mask[i] == (is_ground ? kGround : kNonGround));
  }
}

TEST_CASE("the column test knows no height: a car's roof passes", "[ground][lego]") {
  Sweep sweep(kMaxReturns);
  const auto truth = Scene().level_ground().box({5, -4, 0}, {12, 4, 1.2}).scan(sweep);
  const auto mask = segmented(lego(LegoConfig::Projection::kRing), sweep);
  const auto roof = [&](std::size_t i) { return sweep.z_m[i] > -0.55F; };
  CHECK(share_called_ground(mask, truth, kNonGround, roof) > 0.9);
}

TEST_CASE("the column test ends at its slope: 20 % is steeper than 10 degrees", "[ground][lego]") {
  Sweep sweep(kMaxReturns);
  const auto truth = Scene().ramp(0.2, 15.0).scan(sweep);
  const auto on_ramp = [&](std::size_t i) {
    return sweep.x_m[i] > 16.0F && sweep.ring[i] <= 50 && std::abs(sweep.y_m[i]) < 2.0F;
  };
  GroundConfig config = lego(LegoConfig::Projection::kRing);
  CHECK(share_called_ground(segmented(config, sweep), truth, kGround, on_ramp) < 0.1);
  config.lego.max_slope_deg = 12.0;
  CHECK(share_called_ground(segmented(config, sweep), truth, kGround, on_ramp) > 0.9);
}

TEST_CASE("in a shared pixel of the uniform grid the last return speaks for all", "[ground][lego]") {
  Sweep sweep(10);
  const auto add = [&](float x, float z) {
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = x, sweep.y_m[i] = 0.0F, sweep.z_m[i] = z;
  };
  const GroundConfig config = lego(LegoConfig::Projection::kUniform);
  // Rows 35, 36, 37; the topmost has an empty neighbour and so never is ground here.
  add(10.0F, -1.73F);
  add(10.5F, -1.73F);
  add(11.0F, -1.73F);
  CHECK(segmented(config, sweep) == std::vector<std::uint8_t>{kGround, kGround, kNonGround});
  // Takes the pixel in row 36: steep against row 35, level against row 37.
  add(10.1F, -1.664F);
  CHECK(segmented(config, sweep) == std::vector<std::uint8_t>{kNonGround, kGround, kNonGround, kGround});
}
