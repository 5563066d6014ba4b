// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "assembly/collector.hpp"
#include "support/catch.hpp"

using namespace pago;
using hdl64::FiringReturns;
using hdl64::kLasers;

namespace {

constexpr std::int64_t kPeriod = hdl64::kFiringPeriod_ns;
constexpr std::int64_t kOrigin = 1'790'000'000'000'000'000;

/// Lasers that look up to 10 degrees aside, and rings that are not in laser order.
hdl64::Calibration skewed_calibration() {
  hdl64::Calibration calibration;
  for (int laser = 0; laser < kLasers; ++laser) {
    const auto i = static_cast<std::size_t>(laser);
    calibration.lasers[i].rotation_rad = ((laser * 37) % 201 - 100) * 0.1 * std::numbers::pi / 180.0;
    calibration.ring_of_laser[i] = static_cast<std::uint8_t>((laser * 29 + 5) % kLasers);
  }
  return calibration;
}

/// A firing in which each laser's x is its number, y its firing's, and some lasers see nothing.
FiringReturns returns_of(int firing, const hdl64::Calibration& calibration, unsigned missing = 0) {
  FiringReturns returns{};
  std::mt19937 random(static_cast<unsigned>(firing));
  for (int laser = 0; laser < kLasers; ++laser) {
    if (random() % 100 < missing) continue;
    const auto n = static_cast<std::size_t>(returns.size++);
    returns.x_m[n] = static_cast<float>(laser);
    returns.y_m[n] = static_cast<float>(firing);
    returns.z_m[n] = 1.5F;
    returns.intensity[n] = static_cast<std::uint8_t>(firing);
    returns.ring[n] = calibration.ring_of_laser[static_cast<std::size_t>(laser)];
    returns.laser[n] = static_cast<std::uint8_t>(laser);
  }
  return returns;
}

/// A head that turns steadily: firing i is at `start + i * rate * 48 us` revolutions.
struct Head {
  double rate_rev_s = 10.0;
  double start_rev = 0.5;
  unsigned missing = 10;  // percent of the returns

  Firing firing(int i) const {
    const std::int64_t after_ns = i * kPeriod;
    return {.time_ns = kOrigin + after_ns,
            .arrival_ns = kOrigin + after_ns + 1'000'000,
            .revolutions = start_rev + rate_rev_s * static_cast<double>(after_ns) * 1e-9,
            .rate_rev_s = rate_rev_s};
  }
};

struct Rig {
  explicit Rig(const AssemblyConfig& config = {}, std::size_t ring = 3, std::uint32_t max_returns = 278'528)
      : collector(ring, max_returns), assembler(config, calibration, collector) {}
  void add(const Head& head, int begin, int end) {
    for (int i = begin; i < end; ++i) assembler.add(head.firing(i), returns_of(i, calibration, head.missing));
  }
  const SweepHeader& header(std::size_t sweep) const { return collector.sweeps.at(sweep).header; }

  hdl64::Calibration calibration = skewed_calibration();
  test::Collector collector;
  Assembler assembler;
};

AssemblyConfig cut_at(double azimuth_deg) {
  AssemblyConfig config;
  config.cut_azimuth_deg = azimuth_deg;
  return config;
}

}  // namespace

TEST_CASE("a return's column is its firing's, moved against its laser's rotCorrection and wrapped",
          "[assembly][assembler]") {
  Rig rig;
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
      REQUIRE(sweep.column[i] == (column % columns + columns) % columns);
      REQUIRE(sweep.ring[i] == (laser * 29 + 5) % kLasers);
      REQUIRE(sweep.intensity[i] == static_cast<std::uint8_t>(firing));
      REQUIRE(sweep.z_m[i] == 1.5F);
      REQUIRE(sweep.time_offset_ns[i] ==
              (firing - first_firing) * kPeriod + hdl64::FiringDecoder::laser_time_ns(laser));
    }
  };
  rig.add(head, 0, 6000);
  CHECK(checked > 120'000);
}

TEST_CASE("a steady head gives whole sweeps with full headers", "[assembly][assembler]") {
  Rig rig;
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
    Rig rig(cut_at(cut_deg));
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
    Rig rig;
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
  Rig rig;
  const Head head{.start_rev = 0.75};  // a quarter after the cut
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    const int columns = static_cast<int>(sweep.header.num_columns);
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const int laser = static_cast<int>(sweep.x_m[i]), firing = static_cast<int>(sweep.y_m[i]);
      const double azimuth_deg = 90.0 + firing * 0.1728 - ((laser * 37) % 201 - 100) * 0.1;
      const double off = sweep.column[i] - azimuth_deg / 0.1728;
      REQUIRE(std::abs(std::remainder(off, columns)) < 2.1);
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
  Rig rig;
  rig.add({.start_rev = 0.8}, 0, 300);
  rig.assembler.finish();
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.header(0).flags == (kPartialStart | kPartialEnd));
  CHECK(rig.assembler.counters().partial == 1);
}

TEST_CASE("lost firings leave their columns empty and are counted where they were due",
          "[assembly][assembler]") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    Rig rig;
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
  Rig whole, holed;
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
  Rig rig;
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
  Rig rig;
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
  Rig rig;
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
  Rig rig({}, 3, 64'000);
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
  Rig rig({}, 2);
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

TEST_CASE("sectors cover the sweep, and none changes after it was handed on", "[assembly][assembler]") {
  for (const int sectors : {2, 6, 7, 36, 72}) {
    INFO(sectors << " sectors");
    AssemblyConfig config;
    config.sectors = sectors;
    Rig rig(config), whole;
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
          if (column < columns_until) REQUIRE(now == kept);
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
  Rig rig(config);
  double turned = 0.5;
  for (int i = 0; i < 12'000; ++i) {
    const double rate_rev_s = 20.0 - 15.0 * i / 12'000.0;
    rig.assembler.add({kOrigin + i * kPeriod, 0, turned, rate_rev_s}, returns_of(i, rig.calibration, 90));
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
  Rig rig(config, 2);
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

TEST_CASE("malformed datagrams are noted in the sweep they came in", "[assembly][assembler]") {
  Rig rig;
  rig.assembler.note_bad_packet();
  rig.add({}, 0, 1000);
  rig.assembler.note_bad_packet();
  rig.assembler.note_bad_packet();
  rig.add({}, 1000, 5000);
  CHECK(rig.header(0).packets_bad == 2);
  CHECK(rig.header(1).packets_bad == 0);
}

TEST_CASE("firings without returns make a sweep all the same", "[assembly][assembler]") {
  Rig rig;
  rig.add({.missing = 100}, 0, 2100);
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.collector.sweeps[0].size == 0);
  CHECK(rig.header(0).firings_received >= 2083);
}
