// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <cmath>
#include <random>

#include "assembly/assembler_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("a return's column is its firing's, moved against its laser's rotCorrection and wrapped",
          "[assembly][assembler]") {
  AssemblerRig rig;
  const Head head{.rate_rev_s = 9.6517};
  const double step_deg = head.rate_rev_s * 360.0 * 48e-6;
  int checked = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    if (sweep.header.sequence != 1) return;
    const int columns = static_cast<int>(sweep.header.num_columns);
    const int first_firing = static_cast<int>((sweep.header.start_ns - kOrigin) / kPeriod);
    for (std::uint32_t i = 0; i < sweep.size; ++i, ++checked) {
      const int laser = static_cast<int>(sweep.x_m[i]), firing = static_cast<int>(sweep.y_m[i]);
      const double rotation_deg = ((laser * 37) % 201 - 100) * 0.1;
      const int column = firing - first_firing - static_cast<int>(std::lround(rotation_deg / step_deg));
      REQUIRE_EACH(sweep.column[i] == (column % columns + columns) % columns);
      REQUIRE_EACH(sweep.ring[i] == (laser * 29 + 5) % kLasers);
      REQUIRE_EACH(sweep.intensity[i] == static_cast<std::uint8_t>(firing));
      REQUIRE_EACH(sweep.z_m[i] == 1.5F);
      REQUIRE_EACH(sweep.time_offset_ns[i] ==
                   (firing - first_firing) * kPeriod + hdl64::laser_time_ns(laser));
    }
  };
  rig.add(head, 0, 6000);
  CHECK(checked > 120'000);
}

TEST_CASE("a steady head gives whole sweeps with full headers", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.add({}, 0, 4 * 2084);
  REQUIRE(rig.collector.sweeps.size() == 4);
  std::int64_t end_ns = kOrigin;
  for (std::size_t i = 0; i < 4; ++i) {
    const SweepHeader& h = rig.header(i);
    CHECK(h.sequence == i);
    CHECK(h.start_ns == end_ns);
    CHECK(h.end_ns == h.start_ns + h.num_columns * kPeriod);
    CHECK((h.num_columns == 2083 || h.num_columns == 2084));
    CHECK(h.firings_received == h.num_columns);
    CHECK(h.firings_lost == 0);
    CHECK(h.rotation_rev == 1.0F);
    CHECK(h.flags == 0);
    CHECK(h.is_posed());
    CHECK(h.first_arrival_ns == h.start_ns + 1'000'000);
    CHECK(h.last_arrival_ns == h.end_ns - kPeriod + 1'000'000);
    end_ns = h.end_ns;
  }
  CHECK(rig.assembler.counters().opened == 5);
  CHECK(rig.assembler.counters().is_open == 1);
  CHECK(rig.assembler.counters().balanced());
}

TEST_CASE("sweeps are cut at any angle and from any start, within half a firing", "[assembly][assembler]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 60; ++trial) {
    const double cut_deg = trial == 0 ? 0.0 : trial == 1 ? 360.0 : 360.0 * unit(random);
    const Head head{.rate_rev_s = 5.0 + 15.0 * unit(random), .start_rev = 40.0 * unit(random), .missing = 95};
    const double step = head.rate_rev_s * 48e-6;
    INFO("cut " << cut_deg << " rate " << head.rate_rev_s << " start " << head.start_rev);
    AssemblerRig rig(cut_at(cut_deg));
    rig.collector.on_part = [&](const SweepPart& part) {
      const SweepHeader& h = part.sweep->header;
      if (h.has(kPartialStart) || h.sequence == 0) return;
      const double turned = head.rate_rev_s * static_cast<double>(h.start_ns - kOrigin) * 1e-9;
      const double past_cut = head.start_rev + turned - cut_deg / 360.0;
      REQUIRE(std::abs(past_cut - std::round(past_cut)) <= 0.5001 * step);
    };
    const int firings = static_cast<int>(3.5 / step);
    rig.add(head, 0, firings);
    rig.assembler.finish();
    CHECK(rig.collector.received() == static_cast<std::uint32_t>(firings));
    CHECK(rig.collector.lost() == 0);
    REQUIRE(rig.collector.sweeps.size() >= 4);
    for (std::size_t i = 0; i < rig.collector.sweeps.size(); ++i) {
      const SweepHeader& h = rig.header(i);
      const bool is_first = i == 0, is_last = i + 1 == rig.collector.sweeps.size();
      CHECK(h.sequence == i);
      CHECK(h.has(kPartialStart) == (is_first && h.rotation_rev < 0.9F));
      CHECK(h.has(kPartialEnd) == (is_last && h.rotation_rev < 0.9F));
      CHECK_FALSE(h.has(kIncomplete));
      CHECK_FALSE(h.has(kAfterGap));
      CHECK(std::abs(h.num_columns - 1.0 / step) <= 1.5);
    }
    CHECK(rig.assembler.counters().balanced());
  }
}

TEST_CASE("a stream that starts within one firing of the cut starts with a whole sweep",
          "[assembly][assembler]") {
  const double step = 10.0 * 48e-6;
  for (const double offset : {-0.99, -0.6, -0.4, -0.01, 0.0, 0.01, 0.4, 0.9}) {
    INFO(offset << " firings after the cut");
    AssemblerRig rig;
    rig.add({.start_rev = 7.5 + offset * step}, 0, 3 * 2084);
    REQUIRE(rig.collector.sweeps.size() >= 2);
    CHECK(rig.header(0).flags == 0);
    CHECK(rig.header(0).sequence == 0);
    CHECK(rig.header(0).start_ns == kOrigin);
    CHECK(rig.header(0).firings_received >= 2082);
    CHECK(rig.header(1).sequence == 1);
  }
}

TEST_CASE("a partial sweep's columns keep their angles", "[assembly][assembler]") {
  AssemblerRig rig;
  const Head head{.start_rev = 0.75};  // a quarter after the cut
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    const int columns = static_cast<int>(sweep.header.num_columns);
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const int laser = static_cast<int>(sweep.x_m[i]), firing = static_cast<int>(sweep.y_m[i]);
      const double azimuth_deg = 90.0 + firing * 0.1728 - ((laser * 37) % 201 - 100) * 0.1;
      const double off = sweep.column[i] - azimuth_deg / 0.1728;
      REQUIRE_EACH(std::abs(std::remainder(off, columns)) < 2.1);
    }
  };
  rig.add(head, 0, 1600);
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.header(0).has(kPartialStart));
  CHECK(rig.header(0).rotation_rev == Approx(0.75).margin(1e-3));
  CHECK(rig.header(0).num_columns == 2083);
  CHECK(rig.header(0).firings_lost == 0);
  rig.assembler.finish();
  CHECK(rig.header(1).has(kPartialEnd));
  CHECK(rig.header(1).num_columns == 2083);
  CHECK(rig.header(1).firings_received == rig.collector.received() - rig.header(0).firings_received);
}

TEST_CASE("a stream inside one rotation is partial at both ends", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.add({.start_rev = 0.8}, 0, 300);
  rig.assembler.finish();
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.header(0).flags == (kPartialStart | kPartialEnd));
  CHECK(rig.assembler.counters().partial == 1);
}

TEST_CASE("firings without returns make a sweep all the same", "[assembly][assembler]") {
  AssemblerRig rig;
  rig.add({.missing = 100}, 0, 2100);
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.collector.sweeps[0].size == 0);
  CHECK(rig.header(0).firings_received >= 2083);
}
