// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>

#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr std::uint16_t kPlant = semantic_kitti::kVegetation;

/// Only the errors that are asked for.
GroundConfig flawed(double flips, double misses, double plants) {
  GroundConfig config;
  config.method = "truth-errors";
  config.truth_errors.flip_rate = flips;
  config.truth_errors.missed_patch_rate = misses;
  config.truth_errors.taken_vegetation_rate = plants;
  return config;
}

/// A road, and plants beside it.
std::vector<std::uint8_t> scan_road(Sweep& sweep) {
  auto truth = Scene().level_ground().box({-60, 6, 0}, {60, 8, 1.0}).scan(sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    if (truth[i] != kGround) sweep.label[i] = kPlant;
  return truth;
}

bool everywhere(std::size_t) {
  return true;
}

}  // namespace

TEST_CASE("the truth is what the labels say, without labels nothing is ground", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  const auto truth = scan_road(sweep);
  GroundConfig config;
  config.method = "truth";
  CHECK(segmented(config, sweep) == truth);
  sweep.header.flags = 0;
  const auto mask = segmented(config, sweep);
  CHECK(std::count(mask.begin(), mask.end(), kGround) == 0);
}

TEST_CASE("low plants are ground for the truth only if wanted", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  scan_road(sweep);
  GroundConfig config;
  config.method = "truth";
  config.truth.low_vegetation = true;
  const auto mask = segmented(config, sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    if (sweep.label[i] == kPlant) REQUIRE(mask[i] == (sweep.z_m[i] < -0.75F * 1.73F ? kGround : kNonGround));
}

TEST_CASE("no errors, no difference", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  const auto truth = scan_road(sweep);
  CHECK(segmented(flawed(0.0, 0.0, 0.0), sweep) == truth);
}

TEST_CASE("flips turn round as many verdicts as asked for, both ways", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  const auto truth = scan_road(sweep);
  const auto mask = segmented(flawed(0.1, 0.0, 0.0), sweep);
  CHECK(share_called_ground(mask, truth, kGround, everywhere) == Approx(0.9).margin(0.01));
  CHECK(share_called_ground(mask, truth, kNonGround, everywhere) == Approx(0.1).margin(0.02));
  CHECK(segmented(flawed(1.0, 0.0, 0.0), sweep) != truth);
}

TEST_CASE("missed patches are missed as a whole, and nothing else changes", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  const auto truth = scan_road(sweep);
  const GroundConfig config = flawed(0.0, 0.2, 0.0);
  const auto mask = segmented(config, sweep);
  CHECK(share_called_ground(mask, truth, kNonGround, everywhere) == 0.0);
  std::map<std::pair<int, int>, std::array<int, 2>> patches;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (truth[i] != kGround) continue;
    const auto cell = [&](float metres) { return static_cast<int>(std::floor(metres / 2.0F)); };
    ++patches[{cell(sweep.x_m[i]), cell(sweep.y_m[i])}][mask[i]];
  }
  double missed = 0.0;
  for (const auto& [place, count] : patches) {
    REQUIRE((count[0] == 0 || count[1] == 0));
    missed += count[0] > 0 ? 1.0 : 0.0;
  }
  CHECK(missed / static_cast<double>(patches.size()) == Approx(0.2).margin(0.05));
}

TEST_CASE("only plants are taken for ground", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  const auto truth = scan_road(sweep);
  const auto mask = segmented(flawed(0.0, 0.0, 1.0), sweep);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    REQUIRE(mask[i] == (truth[i] == kGround || sweep.label[i] == kPlant ? kGround : kNonGround));
}

TEST_CASE("another seed or another sweep has other errors", "[ground][truth]") {
  Sweep sweep(kMaxReturns);
  scan_road(sweep);
  GroundConfig config = flawed(0.1, 0.1, 0.1);
  const auto first = segmented(config, sweep);
  CHECK(segmented(config, sweep) == first);
  sweep.header.sequence = 1;
  CHECK(segmented(config, sweep) != first);
  sweep.header.sequence = 0;
  config.truth_errors.seed = 2;
  CHECK(segmented(config, sweep) != first);
}
