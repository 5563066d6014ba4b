// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "assembly/assembler_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("lost firings leave their columns empty and are counted where they were due",
          "[assembly][assembler]") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    AssemblerRig rig;
    const Head head{.rate_rev_s = 7.0 + 0.4 * trial, .missing = 90};
    int lost = 0, sent = 0;
    for (int i = 0; i < 12'000; ++i) {
      const bool is_lost = i != 0 && i != 11'999 && (random() % 50 == 0 || (i / 6) % 97 < 5);
      lost += is_lost;
      if (is_lost) continue;
      rig.add(head, i, i + 1);
      ++sent;
    }
    rig.assembler.finish();
    CHECK(rig.collector.received() == static_cast<std::uint32_t>(sent));
    CHECK(rig.collector.lost() == static_cast<std::uint32_t>(lost));
    const double per_rotation = 1.0 / (head.rate_rev_s * 48e-6);
    for (const auto& sweep : rig.collector.sweeps) {
      CHECK(std::abs(sweep.header.num_columns - per_rotation) < 1.5);
      CHECK_FALSE(sweep.header.has(kAfterGap));
    }
  }
}

TEST_CASE("columns after a loss are where they would have been without it", "[assembly][assembler]") {
  AssemblerRig whole, holed;
  whole.collector.with_digest = holed.collector.with_digest = true;
  std::vector<std::uint16_t> columns_whole, columns_holed;
  const auto keep = [](std::vector<std::uint16_t>& into) {
    return [&into](const SweepPart& part) {
      for (std::uint32_t i = 0; i < part.sweep->size; ++i)
        if (part.sweep->y_m[i] >= 1500.0F) into.push_back(part.sweep->column[i]);
    };
  };
  whole.collector.on_part = keep(columns_whole);
  holed.collector.on_part = keep(columns_holed);
  whole.add({}, 0, 2100);
  holed.add({}, 0, 1000);
  holed.add({}, 1500, 2100);
  CHECK(columns_whole == columns_holed);
  CHECK(holed.header(0).firings_lost == 500);
  CHECK(holed.header(0).has(kIncomplete));
}

TEST_CASE("a gap over a cut is shared out, one over rotations is flagged", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.add({}, 0, 1900);  // 2083.3 firings a rotation
  rig.add({}, 2400, 4000);
  rig.add({}, 9000, 10'500);
  REQUIRE(rig.collector.sweeps.size() == 3);
  CHECK(rig.header(0).firings_lost == 183);
  CHECK(rig.header(0).flags == 0);  // 91 % of it came
  CHECK(rig.header(0).rotation_rev == 1.0F);
  CHECK(rig.header(1).sequence == 1);
  CHECK(rig.header(1).firings_lost == 317 + 167);
  CHECK(rig.header(1).flags == kIncomplete);
  CHECK(rig.header(2).sequence == 4);
  CHECK(rig.header(2).firings_lost == 9000 - 8333);
  CHECK(rig.header(2).flags == (kAfterGap | kIncomplete));
  CHECK(rig.assembler.counters().incomplete == 2);
}

TEST_CASE("an interrupted stream goes on in a new sweep", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.add({}, 0, 3000);
  rig.assembler.interrupt();
  rig.assembler.interrupt();
  REQUIRE(rig.collector.sweeps.size() == 2);
  CHECK(rig.header(1).flags == kIncomplete);
  CHECK(rig.header(1).firings_lost == 0);
  rig.add({.start_rev = 77.1}, 0, 5000);  // another clock, another count of turns
  CHECK(rig.header(2).flags == (kAfterGap | kIncomplete));
  CHECK(rig.header(2).sequence > 1);
  CHECK(rig.header(3).flags == 0);
  CHECK(rig.header(3).sequence == rig.header(2).sequence + 1);
  CHECK(rig.assembler.counters().balanced());
}

TEST_CASE("a head that slows down below 5 Hz fills sweeps that are closed early, one per rotation",
          "[assembly][assembler]") {
  AssemblerRig rig;
  const Head head{.rate_rev_s = 3.0, .missing = 50};
  rig.add(head, 0, 3 * 6945);
  rig.assembler.finish();
  REQUIRE(rig.collector.sweeps.size() >= 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(rig.header(i).sequence == i);
    CHECK(rig.header(i).has(kOverfull));
    CHECK(rig.header(i).num_columns == kMaxColumns);
    CHECK(rig.header(i).rotation_rev == Approx(kMaxColumns / 6944.4).margin(1e-3));
  }
  CHECK(rig.assembler.counters().overfull >= 3);
}

TEST_CASE("a sweep that is full of returns is closed early, and the next one begins at the cut",
          "[assembly][assembler]") {
  AssemblerRig rig({}, 3, 64'000);
  rig.add({.missing = 0}, 0, 5000);
  REQUIRE(rig.collector.sweeps.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(rig.collector.sweeps[i].size == 64'000);
    CHECK(rig.header(i).flags == (kOverfull | kIncomplete));
    CHECK(rig.header(i).num_columns == 2083);
    CHECK(rig.header(i).firings_received == 1000);
    CHECK(rig.header(i).rotation_rev == Approx(0.48).margin(1e-3));
  }
  CHECK(rig.header(1).start_ns - rig.header(0).start_ns == Approx(1e8).margin(48e3));
}

TEST_CASE("when no sweep is free the newest rotation is kept", "[assembly][assembler]") {
  AssemblerRig rig({}, 2);
  rig.collector.frees_at_once = false;
  rig.add({}, 0, 6 * 2084);  // sweep 0 is handed on, then there is no second one for 1, 2, 3, 4
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.assembler.counters().opened == 7);
  CHECK(rig.assembler.counters().no_free_sweep == 5);
  CHECK(rig.assembler.counters().balanced());
  rig.collector.ring().release(rig.collector.parts[0].sweep);
  rig.collector.frees_at_once = true;
  rig.add({}, 6 * 2084, 8 * 2084);
  REQUIRE(rig.collector.sweeps.size() == 3);
  CHECK(rig.header(1).sequence == 6);
  CHECK(rig.header(1).flags == 0);
  CHECK(rig.header(2).sequence == 7);
  CHECK(rig.assembler.counters().balanced());
}

TEST_CASE("malformed datagrams are noted in the sweep they came in", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.assembler.note_bad_packet();
  rig.add({}, 0, 1000);
  rig.assembler.note_bad_packet();
  rig.assembler.note_bad_packet();
  rig.add({}, 1000, 5000);
  CHECK(rig.header(0).packets_bad == 2);
  CHECK(rig.header(1).packets_bad == 0);
}
