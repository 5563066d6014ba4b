// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Streams that become something else while they run: return mode, speed, sender, sensor.
#include <algorithm>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"
#include "support/status_cycle.hpp"

using namespace pago;
using namespace pago::test;

namespace {

/// Pushes a packet as if it came from 192.168.3.`host`.
void push_from(IngestRig& rig, unsigned host, const PacketBytes& bytes, std::int64_t arrival_ns) {
  rig.buffer = bytes;
  rig.ingest.push({.payload = rig.buffer,
                   .arrival_ns = arrival_ns,
                   .source_ipv4 = 0xC0A80300U + host,
                   .source_port = 443,
                   .destination_port = 2368});
  rig.check_identities();
}

/// A packet of an HDL-32E.
PacketBytes hdl32_packet(int i) {
  PacketBuilder builder;
  for (int block = 0; block < hdl64::kBlocks; ++block) builder.flag(block, hdl64::kUpperBlock);
  return builder.azimuths_cdeg(40 * i % 36000, 4)
      .stamp_us(static_cast<std::uint32_t>(553 * i))
      .status(0x37, 0x21)
      .bytes();
}

bool is_clean(const SweepHeader& h) {
  return h.flags == 0 && h.firings_lost == 0;
}

}  // namespace

TEST_CASE("a return mode that is switched while the sensor runs costs two sweeps", "[assembly][changes]") {
  const auto check = [](const hdl64::StreamFormat& before, const hdl64::StreamFormat& after) {
    const StreamSettings first{.format = before};
    StreamSettings second{.azimuth_deg = 250.0, .format = after};
    const int switched = 3000;
    second.stamp_us += static_cast<std::uint32_t>(switched * before.packet_period_ns() / 1000);
    second.arrival_ns += switched * before.packet_period_ns();
    IngestRig rig;
    rig.push(PacketStream(first), 0, switched);
    rig.push(PacketStream(second), 0, 4000);
    CHECK(rig.ingest.format() == after);
    CHECK(rig.ingest.format_changes() == 1);
    CHECK(rig.ingest.clock_restarts() == 0);
    CHECK(rig.ingest.packets().decoded > 6980);
    const auto& sweeps = rig.collector.sweeps;
    const auto unclean = std::count_if(sweeps.begin(), sweeps.end(),
                                       [](const auto& sweep) { return !is_clean(sweep.header); });
    CHECK(unclean <= 2);
    CHECK(is_clean(sweeps.back().header));
    CHECK(is_clean(sweeps[sweeps.size() - 3].header));
  };
  check(single_return(), dual_return());
  check(dual_return(), single_return());
  check(dual_return(), single_return_s3());
  check(single_return_s3(), single_return());
}

TEST_CASE("single returns after dual ones are no echoes", "[assembly][changes]") {
  const StreamSettings first{.raw = 3000, .format = dual_return(), .second_raw = 5000};
  StreamSettings second{.azimuth_deg = 250.0, .format = single_return_s3()};
  const int switched = 3000;
  second.stamp_us += static_cast<std::uint32_t>(switched * first.format.packet_period_ns() / 1000);
  second.arrival_ns += switched * first.format.packet_period_ns();
  IngestRig rig;
  rig.collector.allows_echoes = true;
  std::uint32_t echoes = 0, of_last = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    const auto* const begin = part.sweep->echo.begin();
    of_last = static_cast<std::uint32_t>(
        std::count_if(begin, begin + part.sweep->size, [](std::uint8_t echo) { return echo != 0; }));
    echoes += of_last;
  };
  rig.push(PacketStream(first), 0, switched);
  CHECK(echoes > 100'000);
  rig.push(PacketStream(second), 0, 2000);
  CHECK(rig.ingest.format() == second.format);
  for (int packet = 2000; packet < 4000; packet += 400) {
    rig.push(PacketStream(second), packet, packet + 400);
    CHECK(of_last == 0);
  }
}

TEST_CASE("a speed that changes from 5 to 20 Hz and back is followed sweep by sweep", "[assembly][changes]") {
  // Up and down by 3 Hz per second, at rest at neither end.
  StreamSettings settings{.azimuth_deg = 181.0};
  const auto turned_rev = [](double t) {
    const double up = std::clamp(t - 1.0, 0.0, 5.0), top = std::clamp(t - 6.0, 0.0, 1.0),
                 down = std::clamp(t - 7.0, 0.0, 5.0), end = std::max(0.0, t - 12.0);
    return 5.0 * (std::min(t, 1.0) + up + end) + 1.5 * up * up + 20.0 * (top + down) - 1.5 * down * down;
  };
  settings.turned_deg = [=](double t) { return 360.0 * turned_rev(t); };
  const PacketStream stream(settings);
  IngestRig rig;
  double worst_deg = 0.0;
  std::int64_t origin_ns = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    if (origin_ns == 0) origin_ns = sweep.header.start_ns;
    for (std::uint32_t i = 0; i < sweep.size; i += 61) {
      const auto after_ns = sweep.header.start_ns + sweep.time_offset_ns[i] - origin_ns;
      const double seen_deg =
          std::atan2(-double{sweep.y_m[i]}, double{sweep.x_m[i]}) * 180.0 / std::numbers::pi;
      worst_deg =
          std::max(worst_deg, std::abs(std::remainder(seen_deg - stream.true_azimuth_deg(after_ns), 360.0)));
    }
  };
  rig.push(stream, 0, 13 * 3472);
  CHECK(worst_deg < 0.08);
  CHECK(rig.ingest.packets().decoded == 13 * 3472);
  REQUIRE(rig.collector.sweeps.size() > 100);
  std::uint32_t fewest = 10'000, most = 0;
  for (std::size_t i = 0; i < rig.collector.sweeps.size(); ++i) {
    const SweepHeader& h = rig.header(i);
    REQUIRE(h.sequence == i);
    REQUIRE(h.flags == 0);
    REQUIRE(h.firings_lost == 0);
    fewest = std::min(fewest, h.num_columns);
    most = std::max(most, h.num_columns);
  }
  CHECK(fewest == Approx(1042).margin(4));
  CHECK(most == Approx(4167).margin(8));
}

TEST_CASE("a head that stops gives no sweeps until it turns again", "[assembly][changes]") {
  StreamSettings settings{.azimuth_deg = 181.0};
  settings.turned_deg = [](double t) {  // 10 Hz, down to rest from 1 to 3 s, up again from 5 to 7 s
    const double down = std::clamp(t - 1.0, 0.0, 2.0), up = std::clamp(t - 5.0, 0.0, 2.0);
    return 360.0 * (10.0 * std::min(t, 1.0) + 10.0 * down - 2.5 * down * down + 2.5 * up * up +
                    10.0 * std::max(0.0, t - 7.0));
  };
  const PacketStream stream(settings);
  IngestRig rig;
  rig.push(stream, 0, 3 * 3472);
  CHECK(rig.ingest.rotation_hz() == 0.0);
  const std::size_t at_rest = rig.collector.sweeps.size();
  rig.push(stream, 3 * 3472, 5 * 3472);
  CHECK(rig.collector.sweeps.size() <= at_rest + 1);
  CHECK(rig.ingest.packets().pending < 64);
  rig.push(stream, 5 * 3472, 9 * 3472);
  CHECK(rig.ingest.rotation_hz() == Approx(10.0).epsilon(1e-3));
  CHECK(rig.ingest.packets().decoded + rig.ingest.packets().pending == 9 * 3472);
  const std::size_t n = rig.collector.sweeps.size();
  CHECK(n > at_rest + 20);
  for (std::size_t i = n - 15; i < n; ++i) CHECK(is_clean(rig.header(i)));
}

TEST_CASE("packets of a second sensor on the port are filtered to the packet", "[assembly][changes]") {
  const PacketStream ours, other({.rotation_hz = 12.0, .azimuth_deg = 10.0, .stamp_us = 77'000'000});
  IngestRig alone, rig;
  alone.collector.with_digest = rig.collector.with_digest = true;
  for (int i = 0; i < 3000; ++i) {
    push_from(alone, 43, ours.packet(i), ours.arrival_ns(i));
    push_from(rig, 43, ours.packet(i), ours.arrival_ns(i));
    if (i % 3 != 0) push_from(rig, 44, other.packet(i), ours.arrival_ns(i) + 100'000);
  }
  CHECK(rig.ingest.packets().filtered == 2000);
  CHECK(rig.ingest.packets().decoded == 3000);
  CHECK(rig.ingest.sender().ipv4() == 0xC0A8032B);
  CHECK(rig.ingest.sender().other_ipv4() == 0xC0A8032C);
  REQUIRE(rig.collector.sweeps.size() == alone.collector.sweeps.size());
  for (std::size_t i = 0; i < rig.collector.sweeps.size(); ++i)
    CHECK(rig.collector.sweeps[i].digest == alone.collector.sweeps[i].digest);
}

TEST_CASE("of two sensors the HDL-64E is taken, even if the other one is first", "[assembly][changes]") {
  const PacketStream ours;
  IngestRig rig;
  for (int i = 0; i < 1000; ++i) {
    push_from(rig, 44, hdl32_packet(i), ours.arrival_ns(i));
    push_from(rig, 43, ours.packet(i), ours.arrival_ns(i));
  }
  CHECK_FALSE(rig.ingest.is_refused());
  CHECK(rig.ingest.sensor() == hdl64::SensorKind::kHdl64Single);
  CHECK(rig.ingest.packets().filtered == 1015);  // all of the other one's, and ours while it was looked at
  CHECK(rig.ingest.packets().decoded + rig.ingest.packets().pending == 985);
}

TEST_CASE("a sensor that is replaced by another one is found after five seconds", "[assembly][changes]") {
  const PacketStream before;
  StreamSettings settings{.rotation_hz = 12.0, .stamp_us = 5'000'000, .format = dual_return()};
  settings.arrival_ns += 60'000'000'000;
  const PacketStream after(settings);
  IngestRig rig;
  for (int i = 0; i < 2000; ++i) push_from(rig, 43, before.packet(i), before.arrival_ns(i));
  for (int i = 0; i < 4000; ++i) push_from(rig, 99, after.packet(i), after.arrival_ns(i));
  CHECK(rig.ingest.format() == dual_return());
  CHECK(rig.ingest.packets().filtered == 0);
  CHECK(rig.ingest.packets().decoded == 6000);
  CHECK(rig.ingest.rotation_hz() == Approx(12.0).epsilon(1e-3));
  CHECK(is_clean(rig.collector.sweeps.back().header));
}

TEST_CASE("strangers on the port while the sensor is off do not keep it from coming back",
          "[assembly][changes]") {
  const PacketStream before;
  StreamSettings settings{.stamp_us = 5'000'000};
  settings.arrival_ns += 60'000'000'000;
  const PacketStream after(settings);
  IngestRig rig;
  for (int i = 0; i < 2000; ++i) push_from(rig, 43, before.packet(i), before.arrival_ns(i));
  for (int i = 0; i < 5000; ++i)
    push_from(rig, 77, hdl32_packet(i), before.arrival_ns(2000) + 10'000'000LL * i);
  CHECK_FALSE(rig.ingest.is_refused());
  for (int i = 0; i < 2000; ++i) push_from(rig, 43, after.packet(i), after.arrival_ns(i));
  CHECK(rig.ingest.packets().filtered == 5000);
  CHECK(rig.ingest.packets().decoded == 2000 + 2000);
}

TEST_CASE("thousands of stray datagrams neither refuse the sensor nor disturb it", "[assembly][changes]") {
  const PacketStream stream;
  IngestRig rig;
  const std::array<std::uint8_t, 512> stray{};
  for (int i = 0; i < 3000; ++i) rig.ingest.push({.payload = stray, .arrival_ns = stream.arrival_ns(i) - 1});
  CHECK_FALSE(rig.ingest.is_refused());
  for (int i = 0; i < 1000; ++i) {
    rig.push(stream, i, i + 1);
    rig.ingest.push({.payload = std::span(stray).first(200), .arrival_ns = stream.arrival_ns(i)});
  }
  CHECK(rig.bad(PacketFault::kSize) == 4000);
  CHECK(rig.ingest.packets().decoded == 1000);
}

TEST_CASE("the power level takes effect where it is first said", "[assembly][changes]") {
  StatusOptions options;
  options.says.power_level = 0xA0;
  const hdl64::Calibration unit = plain_calibration();
  const StatusCycle cycle = make_status_cycle(unit, options);
  const PacketStream stream({.raw = 4007});
  const std::int64_t said_at = 4160 - 16 + 13;  // byte 5 of the last cycle
  IngestRig rig;
  std::int64_t origin_ns = 0;
  bool right = true;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    if (origin_ns == 0) origin_ns = sweep.header.start_ns;
    for (std::uint32_t i = 0; i < sweep.size; i += 64) {
      const std::int64_t packet = (sweep.header.start_ns + sweep.time_offset_ns[i] - origin_ns) / 288'000;
      const float range_m = std::hypot(sweep.x_m[i], sweep.y_m[i]);
      right &= std::abs(range_m - (packet < said_at ? 8.014F : 8.0F)) < 1e-4F;
    }
  };
  for (int i = 0; i < 6000; ++i) {
    PacketBytes bytes = stream.packet(i);
    bytes[1204] = cycle[static_cast<std::size_t>(i) % 4160].type;
    bytes[1205] = cycle[static_cast<std::size_t>(i) % 4160].value;
    rig.push(bytes, stream.arrival_ns(i));
  }
  CHECK(right);
  CHECK(rig.collector.sweeps.size() > 15);
  CHECK(hdl64::power_level_of(rig.ingest.status().status()) == hdl64::PowerLevel::kRaw);

  hdl64::Calibration foretelling = unit;
  foretelling.power_level = hdl64::PowerLevel::kRaw;
  IngestRig foretold({}, 3, foretelling);
  foretold.collector.on_part = [&](const SweepPart& part) {
    CHECK(std::hypot(part.sweep->x_m[0], part.sweep->y_m[0]) == Approx(8.0));
  };
  foretold.push(stream, 0, 1000);
  CHECK(foretold.collector.sweeps.size() == 2);
}

TEST_CASE("the sensor's own calibration is held against the one in use", "[assembly][changes]") {
  hdl64::Calibration other = plain_calibration();
  for (auto& laser : other.lasers) laser.vertical_rad += 0.01;
  for (const bool is_own : {true, false}) {
    const StatusCycle cycle = make_status_cycle(is_own ? plain_calibration() : other);
    const PacketStream stream;
    IngestRig rig;
    for (int i = 0; i < 4400; ++i) {
      if (i == 4100) CHECK_FALSE(rig.ingest.calibration_difference().has_value());
      PacketBytes bytes = stream.packet(i);
      bytes[1204] = cycle[static_cast<std::size_t>(i) % 4160].type;
      bytes[1205] = cycle[static_cast<std::size_t>(i) % 4160].value;
      rig.push(bytes, stream.arrival_ns(i));
    }
    REQUIRE(rig.ingest.calibration_difference().has_value());
    CHECK(rig.ingest.calibration_difference()->is_other_unit() == !is_own);
  }
}
