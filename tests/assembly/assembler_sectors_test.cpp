// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <vector>

#include "assembly/assembler_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("sectors cover the sweep, and none changes after it was handed on", "[assembly][assembler]") {
  for (const int sectors : {2, 6, 7, 36, 72}) {
    INFO(sectors << " sectors");
    AssemblyConfig config;
    config.sectors = sectors;
    AssemblerRig rig(config), whole;
    rig.collector.with_digest = whole.collector.with_digest = true;
    std::vector<std::int32_t> cells(kNumRings * kMaxColumns);  // as they were when they were closed
    std::uint32_t columns_until = 0, returns_until = 0;
    int parts = 0;
    rig.collector.on_part = [&](const SweepPart& part) {
      REQUIRE(part.columns_until >= columns_until);
      REQUIRE(part.returns_until >= returns_until);
      REQUIRE(part.returns_until <= part.sweep->size);
      const RangeImage& image = part.sweep->range_image;
      for (std::uint32_t column = kColumnMargin; column < part.columns_until; ++column)
        for (std::uint32_t ring = 0; ring < kNumRings; ++ring) {
          std::int32_t& kept = cells[ring * kMaxColumns + column];
          const std::int32_t now = image.at(static_cast<int>(ring), static_cast<int>(column));
          if (column < columns_until) REQUIRE_EACH(now == kept);
          kept = now;
        }
      columns_until = part.last ? 0 : part.columns_until;
      returns_until = part.last ? 0 : part.returns_until;
      ++parts;
    };
    rig.add({}, 0, 2 * 2084);
    whole.add({}, 0, 2 * 2084);
    REQUIRE(rig.collector.sweeps.size() == 2);
    CHECK(parts <= 2 * sectors);
    CHECK(parts >= 1.9 * sectors);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(rig.collector.sweeps[i].digest == whole.collector.sweeps[i].digest);
  }
}

TEST_CASE("a sweep has no more parts than sectors, however the head slows down", "[assembly][assembler]") {
  AssemblyConfig config;
  config.sectors = 12;
  AssemblerRig rig(config);
  double turned = 0.5;
  for (int i = 0; i < 12'000; ++i) {
    const double rate_rev_s = 20.0 - 15.0 * i / 12'000.0;
    rig.assembler.add({kOrigin + i * kPeriod, 0, turned, rate_rev_s}, returns_of(i, 90));
    turned += rate_rev_s * 48e-6;
  }
  int parts = 0;
  for (const SweepPart& part : rig.collector.parts) {
    CHECK(++parts <= 12);
    if (part.last) parts = 0;
  }
  CHECK(rig.collector.sweeps.size() > 4);
}

TEST_CASE("a sweep begun in sectors is finished though no other is free", "[assembly][assembler]") {
  AssemblyConfig config;
  config.sectors = 6;
  AssemblerRig rig(config, 2);
  rig.collector.frees_at_once = false;
  rig.add({}, 0, 5 * 2084);
  REQUIRE(rig.collector.sweeps.size() == 2);
  CHECK(rig.header(1).sequence == 1);
  CHECK(rig.assembler.counters().no_free_sweep == 4);
  rig.collector.ring().release(rig.collector.parts.front().sweep);
  rig.add({}, 5 * 2084, 7 * 2084);
  REQUIRE(rig.collector.sweeps.size() == 3);
  CHECK(rig.header(2).sequence == 6);  // rotation 5 had begun when the sweep became free
  CHECK(rig.assembler.counters().balanced());
}
