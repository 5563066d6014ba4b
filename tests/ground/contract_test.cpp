// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What every ground method must do, whatever its idea. Walks the table: a new row is tested by being there.
#include <algorithm>
#include <limits>
#include <random>

#include "support/alloc_guard.hpp"
#include "support/catch.hpp"
#include "support/scene.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;

static_assert(Stage<ground::Segmenter>);

namespace {

/// A street with a bit of everything.
Scene street() {
  Scene scene;
  scene.level_ground()
      .box({-60, 4, -1}, {60, 20, 0.15}, kGround)
      .box({-60, 12, 0}, {60, 13, 6})
      .box({8, -2, 0}, {12, -0.2, 1.5})
      .box({-14, -3.5, 0}, {-10, -1.7, 1.5})
      .box({-60, -15, 0}, {60, -14, 4});
  return scene;
}

}  // namespace

TEST_CASE("every return gets kGround or kNonGround and nothing else is written", "[ground][contract]") {
  Sweep sweep(kMaxReturns), before(kMaxReturns);
  street().scan(sweep, kNoisy);
  street().scan(before, kNoisy);
  constexpr std::uint8_t kUntouched = 0xA5;
  const auto same = [](const auto& a, const auto& b) { return std::equal(a.begin(), a.end(), b.begin()); };
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    std::fill(sweep.ground.begin(), sweep.ground.end(), kUntouched);
    segmented(c.config, sweep);
    const auto rest = sweep.ground.begin() + sweep.size;
    CHECK(std::all_of(sweep.ground.begin(), rest, [](auto g) { return g == kGround || g == kNonGround; }));
    CHECK(std::all_of(rest, sweep.ground.end(), [](auto g) { return g == kUntouched; }));
    CHECK(sweep.size == before.size);
    CHECK((same(sweep.x_m, before.x_m) && same(sweep.y_m, before.y_m) && same(sweep.z_m, before.z_m)));
    CHECK((same(sweep.ring, before.ring) && same(sweep.column, before.column)));
    CHECK((same(sweep.intensity, before.intensity) && same(sweep.time_offset_ns, before.time_offset_ns)));
    CHECK(same(sweep.cluster, before.cluster));
    for (int ring = 0; ring < kNumRings; ++ring)
      REQUIRE(std::equal(sweep.range_image.row(ring), sweep.range_image.row(ring) + kMaxColumns,
                         before.range_image.row(ring)));
  }
}

TEST_CASE("the same sweep gives the same mask, in any instance and after any other sweep or a reset",
          "[ground][contract]") {
  Sweep sweep(kMaxReturns), other(kMaxReturns);
  street().scan(sweep, kNoisy);
  Scene().ramp(0.1, 5.0).box({-9, -9, 0}, {-6, 9, 2}).scan(other, kNoisy);
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto segmenter = ground::make_segmenter(c.config, Mount{}, sweep.capacity());
    segment(*segmenter, sweep);
    const auto first = mask_of(sweep);
    segment(*segmenter, other);
    if (ground::find_method(c.config.method).traits.has_memory) segmenter->reset();
    segment(*segmenter, sweep);
    CHECK(mask_of(sweep) == first);
    CHECK(segmented(c.config, sweep) == first);
  }
}

TEST_CASE("a height set later is as good as one of the mount", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  const Mount high{.height_m = 2.4};
  ScanOptions from_high = kNoisy;
  from_high.mount = high;
  street().scan(sweep, from_high);
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    const auto expected = segmented(c.config, sweep, high);
    const auto segmenter = ground::make_segmenter(c.config, Mount{}, sweep.capacity());
    segmenter->set_height(high.height_m);
    segment(*segmenter, sweep);
    CHECK(mask_of(sweep) == expected);
  }
}

TEST_CASE("a sweep in parts gives the same mask as at once", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  street().scan(sweep, kNoisy);
  for (const GroundCase& c : ground_cases()) {
    const auto whole = segmented(c.config, sweep);
    const auto segmenter = ground::make_segmenter(c.config, Mount{}, sweep.capacity());
    for (const std::uint32_t parts : {2U, 7U, 36U, 72U}) {
      INFO(c.name << ", " << parts << " parts");
      segmenter->reset();
      std::fill(sweep.ground.begin(), sweep.ground.end(), std::uint8_t{0xA5});
      segmenter->begin(sweep);
      for (std::uint32_t part = 1; part <= parts; ++part) {
        const std::uint32_t until = sweep.size * part / parts;
        // The scene's lasers look where the encoder does: columns before the next return's are final.
        const std::uint32_t columns = part == parts ? sweep.header.num_columns : sweep.column[until];
        segmenter->accept({&sweep, until, columns, part == parts});
      }
      segmenter->finish(sweep);
      CHECK(mask_of(sweep) == whole);
    }
  }
}

TEST_CASE("segmenting touches no heap", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  street().scan(sweep, kNoisy);
  Mount tilted;
  tilted.pitch_rad = 0.1;
  for (const GroundCase& c : ground_cases()) {
    for (const Mount& mount : {Mount{}, tilted}) {
      INFO(c.name << ", pitch " << mount.pitch_rad);
      const AllocationGuard creation;
      const auto segmenter = ground::make_segmenter(c.config, mount, sweep.capacity());
      CHECK(creation.count() > 0);  // the guard sees what it must see
      const AllocationGuard guard;
      segment(*segmenter, sweep);
      CHECK(guard.count() == 0);
    }
  }
}

TEST_CASE("an empty sweep and a single return are segmented", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    sweep.reset();
    CHECK(segmented(c.config, sweep).empty());
    Scene().level_ground().scan(sweep, {.columns = 1});
    sweep.size = 1;
    sweep.range_image.clear(1);
    sweep.range_image.at(sweep.ring[0], 0) = 0;
    const std::uint8_t mask = segmented(c.config, sweep).at(0);
    const bool is_told = ground::find_method(c.config.method).traits.needs_labels;
    CHECK((mask == kNonGround || (is_told && mask == kGround)));
  }
}

TEST_CASE("returns that are zero, NaN or infinite are non-ground and do not disturb the others",
          "[ground][contract]") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Sweep sweep(kMaxReturns);
  std::vector<std::uint8_t> truth;
  for (const GroundCase& c : ground_cases()) {
    INFO(c.name);
    truth = Scene().level_ground().scan(sweep, kNoisy);
    const std::array<std::array<float, 3>, 6> bad{
        {{0, 0, 0}, {kNan, kNan, kNan}, {10, kNan, -1.7F}, {10, 0, kNan}, {kInf, 0, -1.7F}, {10, 0, -kInf}}};
    for (std::uint32_t i = 0; i < sweep.size; i += 10) {
      const auto& p = bad[i / 10 % bad.size()];
      sweep.x_m[i] = p[0], sweep.y_m[i] = p[1], sweep.z_m[i] = p[2];
      truth[i] = kNonGround;
    }
    const auto mask = segmented(c.config, sweep);
    const auto all = [](std::size_t) { return true; };
    CHECK(share_called_ground(mask, truth, kNonGround, all) == 0.0);
    const auto near = [&](std::size_t i) { return range_xy_m(sweep, i) < 20.0; };
    CHECK(share_called_ground(mask, truth, kGround, near) >= c.can.min_recall);
  }
}

TEST_CASE("a sweep without any valid return has no ground", "[ground][contract]") {
  Sweep sweep(kMaxReturns);
  for (const GroundCase& c : ground_cases()) {
    for (const float value : {0.0F, std::numeric_limits<float>::quiet_NaN()}) {
      INFO(c.name << ", all " << value);
      street().scan(sweep, kNoisy);
      for (auto* coordinate : {&sweep.x_m, &sweep.y_m, &sweep.z_m})
        std::fill(coordinate->begin(), coordinate->end(), value);
      const auto mask = segmented(c.config, sweep);
      CHECK(std::count(mask.begin(), mask.end(), kGround) == 0);
    }
  }
}

TEST_CASE("a full sweep of the slowest dual-return rotation is segmented, wherever its returns lie",
          "[ground][contract]") {
  constexpr std::uint32_t kLargest = 460'800;
  Sweep sweep(kLargest);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> anywhere(-100.0F, 100.0F), near(-1.0F, 1.0F);
  for (const GroundCase& c : ground_cases()) {
    for (const bool in_one_bin : {false, true}) {
      INFO(c.name << (in_one_bin ? ", all in one bin" : ", everywhere"));
      sweep.reset();
      sweep.size = kLargest;
      sweep.header.num_columns = kMaxColumns;
      for (std::uint32_t i = 0; i < kLargest; ++i) {
        sweep.x_m[i] = in_one_bin ? 15.0F + 0.1F * near(random) : anywhere(random);
        sweep.y_m[i] = in_one_bin ? 1.0F + 0.1F * near(random) : anywhere(random);
        sweep.z_m[i] = in_one_bin ? -1.73F : 2.0F * near(random);
        sweep.ring[i] = static_cast<std::uint8_t>(i % kNumRings);
        sweep.column[i] = static_cast<std::uint16_t>(i / kNumRings % kMaxColumns);
        sweep.range_image.at(sweep.ring[i], sweep.column[i]) = static_cast<std::int32_t>(i);
      }
      const auto mask = segmented(c.config, sweep);
      CHECK(std::all_of(mask.begin(), mask.end(), [](auto g) { return g == kGround || g == kNonGround; }));
    }
  }
}
