// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Times of sweeps, from streams as sensors and hosts give them over months: with and without GPS, through
// roll-overs, drifts, clocks that are set, power cuts and suspended hosts.
#include <cmath>
#include <functional>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kNoon = 1'790'000'000 / 3600 * 3600 * kSecond;  // a full hour since the epoch
/// Between the end of a packet and its arrival.
constexpr std::int64_t kSent = 100'000;

/// A sensor and its host on the same table, both with clocks of their own.
struct Table {
  char gps = 'A';
  hdl64::StreamFormat format{};
  /// The device's stamp and the host's clock, t seconds after the start.
  std::function<double(double)> stamp_s = [](double t) { return 1799.0 + t; };
  std::function<double(double)> host_s = [](double t) { return 1799.0 + t; };  // after noon
  std::int64_t wrap_us = std::int64_t{hdl64::kStampWrap_us};

  IngestRig rig{};
  std::int64_t next = 0;

  Table& run(double until_s) {
    const PacketStream stream({.format = format});
    for (; static_cast<double>(next * stream.period_ns()) < until_s * 1e9; ++next) {
      const double t = 1e-9 * static_cast<double>(next * stream.period_ns());
      PacketBytes bytes = stream.packet(next);
      if (format.has_stamps()) {
        const auto stamp = static_cast<std::uint32_t>(std::llround(stamp_s(t) * 1e6) % wrap_us);
        std::memcpy(bytes.data() + 1200, &stamp, sizeof stamp);
        bytes[1204] = static_cast<std::uint8_t>("HMSDNYGTV1234567"[next % 16]);
        bytes[1205] = bytes[1204] == 'G' ? static_cast<std::uint8_t>(gps) : 0;
      }
      rig.push(bytes, kNoon + std::llround(host_s(t) * 1e9) + stream.period_ns() + kSent);
    }
    return *this;
  }
  /// Nothing comes for a while.
  Table& silence(double seconds) {
    next += static_cast<std::int64_t>(seconds * 1e9) / format.packet_period_ns();
    return *this;
  }

  const SweepHeader& newest() const { return rig.collector.sweeps.back().header; }
  /// Time of day of the newest sweep's start, minus what the host's clock showed then, seconds.
  double off_host_s() const {
    const SweepHeader& h = newest();
    const double first_seen_s = 1e-9 * static_cast<double>(h.first_arrival_ns - kNoon - kSent);
    const double period_s = 1e-9 * static_cast<double>(format.packet_period_ns());
    return 1e-9 * static_cast<double>(h.start_ns + h.clock_offset_ns - kNoon) - (first_seen_s - period_s);
  }
  /// Every sweep that has no gap before it starts where the one before it ended.
  void check_continuity(std::size_t breaks = 0) const {
    std::size_t found = 0;
    for (std::size_t i = 1; i < rig.collector.sweeps.size(); ++i)
      found += rig.header(i).start_ns == rig.header(i - 1).end_ns ? 0U : 1U;
    CHECK(found == breaks);
  }
};

constexpr double kWithinPacket_s = 3e-4;  // a sweep may start on any firing of its first packet

}  // namespace

TEST_CASE("with GPS the sensor's time is the time of day, whatever the host's clock says",
          "[assembly][sensor_time]") {
  for (const double host_off_s : {0.0, 0.4, -3.0, 600.0, -1500.0}) {
    INFO("host off by " << host_off_s << " s");
    Table table{.host_s = [=](double t) { return 1799.0 + host_off_s + t; }};
    table.run(3.0);
    CHECK(table.newest().clock_offset_ns == 0);
    CHECK(table.off_host_s() == Approx(-host_off_s).margin(kWithinPacket_s));
    table.check_continuity();
  }
}

TEST_CASE("without GPS it is the host's time, whatever the stamps began with", "[assembly][sensor_time]") {
  for (const char gps : {'\0', 'V'}) {
    for (const double stamp_off_s : {0.0, 1.7, -900.0, 1799.0, 3000.0}) {
      INFO("stamps off by " << stamp_off_s << " s");
      Table table{.gps = gps,
                  .stamp_s = [=](double t) { return std::fmod(1799.0 + stamp_off_s + t, 3600.0); }};
      table.run(3.0);
      CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
      table.check_continuity();
    }
  }
}

TEST_CASE("with a pulse alone the sensor has the fraction of a second, the host the seconds",
          "[assembly][sensor_time]") {
  // The device's second is 0.2 s ahead of the host's, and counts from power-on.
  Table table{.gps = 'P', .stamp_s = [](double t) { return 77.2 + t; }};
  table.run(3.0);
  CHECK(table.newest().clock_offset_ns % kSecond == 0);
  CHECK(table.off_host_s() == Approx(0.2).margin(kWithinPacket_s));
}

TEST_CASE("early units have the host's time", "[assembly][sensor_time]") {
  for (const hdl64::StreamFormat& format : {early_s2(), s1()}) {
    Table table{.format = format};
    table.run(3.0);
    CHECK(table.off_host_s() == Approx(0.0).margin(5e-4));
    table.check_continuity();
  }
}

TEST_CASE("a drifting clock is followed, and intervals stay the sensor's", "[assembly][sensor_time]") {
  for (const double ppm : {-80.0, 80.0}) {
    INFO(ppm << " ppm");
    Table table{.gps = '\0', .host_s = [=](double t) { return 1799.0 + t * (1.0 + ppm * 1e-6); }};
    table.run(60.0);
    CHECK(table.off_host_s() == Approx(0.0).margin(5e-4));
    CHECK(table.rig.ingest.clock_offset().drift_ppm() == Approx(ppm).margin(5.0));
    table.check_continuity();
    double last_ns = 0.0;
    for (const auto& sweep : table.rig.collector.sweeps) {
      const double of_day_ns =
          static_cast<double>(sweep.header.start_ns + sweep.header.clock_offset_ns - kNoon);
      REQUIRE(of_day_ns > last_ns);
      last_ns = of_day_ns;
    }
  }
}

TEST_CASE("the hour rolls over with and without GPS, and nothing is noticed", "[assembly][sensor_time]") {
  for (const char gps : {'A', '\0'}) {
    Table table{.gps = gps,
                .stamp_s = [](double t) { return 3598.5 + t; },
                .host_s = [](double t) { return 3598.5 + t; }};
    table.run(4.0);
    CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
    CHECK(table.rig.ingest.clock_restarts() == 0);
    CHECK(table.rig.ingest.firings().lost == 0);
    table.check_continuity();
  }
}

TEST_CASE("a unit that counts beyond the hour to the end of its counter runs on", "[assembly][sensor_time]") {
  for (const double start_s : {3599.0, 4294.0}) {
    Table table{
        .gps = '\0', .stamp_s = [=](double t) { return start_s + t; }, .wrap_us = std::int64_t{1} << 32};
    table.run(3.0);
    CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
    CHECK(table.rig.ingest.clock_restarts() == 0);
    CHECK(table.rig.ingest.firings().lost == 0);
    table.check_continuity();
  }
}

TEST_CASE("a host's clock that is set moves the time of day, and no sweep", "[assembly][sensor_time]") {
  for (const double step_s : {-3600.0, -0.5, 0.5, 86'400.0}) {
    INFO("by " << step_s << " s");
    Table table{.gps = '\0', .host_s = [=](double t) { return 1799.0 + t + (t < 5.0 ? 0.0 : step_s); }};
    table.run(12.0);
    CHECK(table.rig.ingest.clock_offset().steps() == 1);
    CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
    CHECK(table.rig.ingest.packets().decoded == static_cast<std::uint64_t>(table.next));
    CHECK(table.rig.ingest.clock_restarts() == 0);
    table.check_continuity();
    for (const auto& sweep : table.rig.collector.sweeps) CHECK(sweep.header.flags == 0);
  }
}

TEST_CASE("a host's clock that is set does not matter with GPS", "[assembly][sensor_time]") {
  Table table{.host_s = [](double t) { return 1799.0 + t + (t < 5.0 ? 0.0 : 300.0); }};
  table.run(12.0);
  CHECK(table.newest().clock_offset_ns == 0);
  table.check_continuity();
}

TEST_CASE("after a power cut the time of day is right again", "[assembly][sensor_time]") {
  for (const char gps : {'\0', 'A'}) {
    Table table{.gps = gps};
    table.run(3.0).silence(25.0);
    if (gps == '\0') table.stamp_s = [](double t) { return t - 20.0; };  // counts from power-on
    table.run(31.0);
    CHECK(table.rig.ingest.clock_restarts() == (gps == '\0' ? 1 : 0));
    CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
    const SweepHeader& h = table.newest();
    CHECK(h.flags == 0);
  }
}

TEST_CASE("a host that was suspended finds the hour again", "[assembly][sensor_time]") {
  for (const double asleep_s : {40.0, 1900.0, 3600.2, 7199.99, 40'000.0}) {
    for (const char gps : {'A', '\0'}) {
      INFO(asleep_s << " s asleep");
      Table table{.gps = gps, .host_s = [](double t) { return 1799.0 + t * (1.0 + 20e-6); }};
      table.run(3.0).silence(asleep_s).run(6.0 + asleep_s);
      CHECK(table.rig.ingest.clock_restarts() == 0);
      const double drifted_s = gps == 'A' ? -20e-6 * asleep_s : 0.0;
      CHECK(table.off_host_s() == Approx(drifted_s).margin(gps == 'A' ? 1e-3 : 20e-6 * asleep_s + 1e-3));
      CHECK(table.newest().flags == 0);
    }
  }
}

TEST_CASE("GPS that is found makes the sensor's clock begin anew, once", "[assembly][sensor_time]") {
  Table table{.gps = '\0', .stamp_s = [](double t) { return t < 3.0 ? 50.0 + t : 1799.0 + t; }};
  table.run(3.0);
  CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
  CHECK(table.newest().clock_offset_ns != 0);
  table.gps = 'A';
  table.run(6.0);
  CHECK(table.rig.ingest.clock_restarts() == 1);
  CHECK(table.newest().clock_offset_ns == 0);
  CHECK(table.off_host_s() == Approx(0.0).margin(kWithinPacket_s));
}

TEST_CASE("GPS that is lost leaves the sensor's clock in charge", "[assembly][sensor_time]") {
  Table table{.host_s = [](double t) { return 1799.0 + 5.0 + t; }};
  table.run(3.0);
  table.gps = '\0';
  table.run(6.0);
  CHECK(table.newest().clock_offset_ns == 0);
  table.check_continuity();
}
