// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "assembly/collector.hpp"
#include "support/catch.hpp"
#include "support/new_counter.hpp"
#include "support/packet_builder.hpp"

using namespace pago;
using test::PacketBuilder;
using test::PacketStream;
using test::StreamSettings;

namespace {

hdl64::Calibration plain_calibration() {
  hdl64::Calibration calibration;
  for (std::uint8_t laser = 0; laser < hdl64::kLasers; ++laser) calibration.ring_of_laser[laser] = laser;
  return calibration;
}

struct Rig {
  explicit Rig(const AssemblyConfig& config = {}, std::size_t ring = 3)
      : collector(ring), ingest(config, {}, plain_calibration(), collector) {}

  void push(const test::PacketBytes& bytes, std::int64_t arrival_ns) {
    buffer = bytes;
    ingest.push({.payload = buffer, .arrival_ns = arrival_ns});
    buffer.fill(0xAA);  // as a receive buffer would be used again
    check_identities();
  }
  void push(const PacketStream& stream, int begin, int end) {
    for (int i = begin; i < end; ++i) push(stream.packet(i), stream.arrival_ns(i));
  }
  void finish() {
    ingest.finish();
    check_identities();
  }
  void check_identities() const {
    REQUIRE(ingest.packets().balanced());
    REQUIRE(ingest.firings().balanced());
    REQUIRE(ingest.sweeps().balanced());
  }
  const SweepHeader& header(std::size_t sweep) const { return collector.sweeps.at(sweep).header; }
  std::uint64_t bad(PacketFault fault) const { return ingest.packets().bad[static_cast<std::size_t>(fault)]; }

  test::Collector collector;
  PacketIngest ingest;
  test::PacketBytes buffer{};
};

/// The largest angle between a return and where the head of the stream truly pointed, degrees. Packet 0 of
/// the stream is at `origin_ns`; lasers have no offsets, so a return lies where the head points.
double largest_error_deg(const Sweep& sweep, const StreamSettings& settings, std::int64_t origin_ns) {
  double worst = 0.0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const double t = static_cast<double>(sweep.header.start_ns + sweep.time_offset_ns[i] - origin_ns) * 1e-9;
    const double truth_deg = settings.azimuth_deg + 360.0 * settings.rotation_hz * t;
    const double x_m = sweep.x_m[i], y_m = sweep.y_m[i];
    const double seen_deg = std::atan2(-y_m, x_m) * 180.0 / std::numbers::pi;
    worst = std::max(worst, std::abs(std::remainder(seen_deg - truth_deg, 360.0)));
  }
  return worst;
}

}  // namespace

TEST_CASE("from 5 to 20 Hz every packet is used and every return points where the head did",
          "[assembly][packet_ingest]") {
  for (const double rate_hz : {5.0, 7.3, 9.6517, 10.0, 14.9, 20.0}) {
    INFO(rate_hz << " Hz");
    const StreamSettings settings{.rotation_hz = rate_hz, .azimuth_deg = 200.0};
    const PacketStream stream(settings);
    Rig rig;
    double worst_deg = 0.0;
    std::int64_t origin_ns = 0;
    rig.collector.on_part = [&](const SweepPart& part) {
      if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
      worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, origin_ns));
    };
    const int packets = static_cast<int>(3.2 / (rate_hz * 288e-6));
    rig.push(stream, 0, packets);
    rig.finish();
    CHECK(worst_deg < 0.0105);  // 0.01 of the azimuth, the rest of single precision
    CHECK(rig.ingest.packets().decoded == static_cast<std::uint64_t>(packets));
    CHECK(rig.collector.received() == static_cast<std::uint32_t>(6 * packets));
    CHECK(rig.collector.lost() == 0);
    CHECK(rig.ingest.rotation_hz() == Approx(rate_hz).epsilon(1e-3));
    CHECK(rig.ingest.sensor() == hdl64::SensorKind::kHdl64Single);
    REQUIRE(rig.collector.sweeps.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(rig.header(i).sequence == i);
      CHECK(rig.header(i).has(kPartialEnd) == (i == 3));
      CHECK_FALSE(rig.header(i).has(kPartialStart));  // it missed 20 degrees
    }
  }
}

TEST_CASE("time runs on over the top of the hour", "[assembly][packet_ingest]") {
  const PacketStream stream({.azimuth_deg = 0.0, .stamp_us = 3'599'850'000});
  Rig rig;
  rig.push(stream, 0, 2000);
  REQUIRE(rig.collector.sweeps.size() >= 5);
  for (std::size_t i = 1; i < rig.collector.sweeps.size(); ++i)
    CHECK(rig.header(i).start_ns == rig.header(i - 1).end_ns);
  CHECK(rig.collector.lost() == 0);
  CHECK(rig.ingest.clock_restarts() == 0);
  CHECK(rig.ingest.packets().decoded == 2000);
}

TEST_CASE("the setting packet_stamp moves sensor time by one packet", "[assembly][packet_ingest]") {
  const PacketStream stream;
  test::Collector first, last;
  Hdl64Config sensor;
  PacketIngest by_first({}, sensor, plain_calibration(), first);
  sensor.packet_stamp = PacketStamp::kLastFiring;
  PacketIngest by_last({}, sensor, plain_calibration(), last);
  for (int i = 0; i < 400; ++i) {
    const test::PacketBytes bytes = stream.packet(i);
    by_first.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
    by_last.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
  }
  REQUIRE(first.sweeps.size() == 1);
  CHECK(first.sweeps[0].header.start_ns - last.sweeps.at(0).header.start_ns == 288'000);
  CHECK(first.sweeps[0].header.num_columns == last.sweeps[0].header.num_columns);
}

TEST_CASE("doubled and overtaken packets leave no trace but in the counters", "[assembly][packet_ingest]") {
  const PacketStream stream;
  Rig orderly, disorderly;
  orderly.collector.with_digest = disorderly.collector.with_digest = true;
  orderly.push(stream, 0, 2000);
  orderly.finish();
  std::uint64_t doubled = 0, swapped = 0;
  for (int i = 0; i < 2000; ++i) {  // also within the first 64, that are held back
    if (i % 40 == 21) {
      disorderly.push(stream, i + 1, i + 2);
      disorderly.push(stream, i, i + 1);
      ++i, ++swapped;
    } else {
      disorderly.push(stream, i, i + 1);
    }
    if (i % 25 == 0) disorderly.push(stream, i, i + 1), ++doubled;
  }
  disorderly.finish();
  CHECK(disorderly.ingest.packets().duplicate == doubled);
  CHECK(disorderly.ingest.packets().reordered == swapped);
  CHECK(disorderly.ingest.packets().decoded == 2000);
  REQUIRE(disorderly.collector.sweeps.size() == orderly.collector.sweeps.size());
  for (std::size_t i = 0; i < orderly.collector.sweeps.size(); ++i)
    CHECK(disorderly.collector.sweeps[i].digest == orderly.collector.sweeps[i].digest);
}

TEST_CASE("whatever is lost is counted to the packet, and nothing else suffers",
          "[assembly][packet_ingest]") {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    const StreamSettings settings{.rotation_hz = 10.0 + 0.3 * seed, .azimuth_deg = 33.0 * seed};
    const PacketStream stream(settings);
    Rig rig;
    double worst_deg = 0.0;
    std::int64_t origin_ns = 0;
    rig.collector.on_part = [&](const SweepPart& part) {
      if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
      worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, origin_ns));
    };
    std::uint64_t lost = 0;
    const int burst = 300 + static_cast<int>(random() % 2000);
    for (int i = 0; i < 3000; ++i) {
      const bool in_burst = i >= burst && i < burst + 60 * static_cast<int>(seed);
      if (i != 0 && i != 2999 && (random() % 20 == 0 || in_burst))
        ++lost;
      else
        rig.push(stream, i, i + 1);
    }
    rig.finish();
    INFO("seed " << seed);
    CHECK(rig.ingest.packets().decoded == 3000 - lost);
    CHECK(rig.ingest.packets().pending == 0);
    CHECK(rig.ingest.firings().expected == 18'000);
    CHECK(rig.ingest.firings().lost == 6 * lost);
    CHECK(rig.collector.received() == 6 * (3000 - lost));
    // Firings of rotations of which nothing came belong to no sweep.
    if (60 * seed < 300) CHECK(rig.collector.lost() == 6 * lost);
    CHECK(worst_deg < 0.0105);
  }
}

TEST_CASE("malformed datagrams are counted by reason and noted in their sweep", "[assembly][packet_ingest]") {
  const PacketStream stream;
  Rig rig;
  rig.push(stream, 0, 700);
  PacketBuilder builder;
  builder.azimuths_cdeg(100, 18);
  const std::int64_t now = stream.arrival_ns(700);
  rig.push(PacketBuilder(builder).flag(3, 0x1234).bytes(), now);
  rig.push(PacketBuilder(builder).azimuth_cdeg(2, 40'000).bytes(), now);
  rig.push(PacketBuilder(builder).azimuth_cdeg(2, 36'000).bytes(), now);
  rig.push(PacketBuilder(builder).stamp_us(1'000'000'000).bytes(), now);  // well-formed, of no time near
  const std::array<std::uint8_t, 200> stray{};
  rig.ingest.push({.payload = stray, .arrival_ns = now});
  rig.push(stream, 700, 1100);
  CHECK(rig.bad(PacketFault::kBlockFlag) == 1);
  CHECK(rig.bad(PacketFault::kAzimuth) == 2);
  CHECK(rig.bad(PacketFault::kStamp) == 1);
  CHECK(rig.bad(PacketFault::kSize) == 1);
  CHECK(rig.ingest.packets().decoded == 1100);
  CHECK(rig.header(0).packets_bad == 0);
  CHECK(rig.header(2).packets_bad == 5);
}

TEST_CASE("a stream of another sensor is refused by name and not decoded", "[assembly][packet_ingest]") {
  Rig rig;
  PacketBuilder builder;
  for (int block = 0; block < hdl64::kBlocks; ++block) builder.flag(block, hdl64::kUpperBlock);
  for (int i = 0; i < 200; ++i)
    rig.push(PacketBuilder(builder)
                 .azimuths_cdeg(40 * i, 4)
                 .stamp_us(static_cast<std::uint32_t>(553 * i))
                 .status(0x37, 0x21)
                 .bytes(),
             553'000 * i);
  rig.finish();
  CHECK(rig.ingest.is_refused());
  CHECK_THAT(rig.ingest.refusal(), Catch::Contains("HDL-32E"));
  CHECK(rig.collector.sweeps.empty());
  CHECK(rig.ingest.packets().decoded == 0);
  CHECK(rig.ingest.packets().received < 64);
}

TEST_CASE("a stream too short to be recognised is refused with its length", "[assembly][packet_ingest]") {
  Rig rig;
  rig.push(PacketStream(), 0, 15);
  CHECK_FALSE(rig.ingest.is_refused());
  CHECK(rig.ingest.refusal().empty());
  rig.finish();
  CHECK(rig.ingest.is_refused());
  CHECK_THAT(rig.ingest.refusal(), Catch::Contains("15 packets"));
  CHECK(rig.collector.sweeps.empty());
}

TEST_CASE("a stream of 16 packets is enough", "[assembly][packet_ingest]") {
  Rig rig;
  rig.push(PacketStream(), 0, 16);
  CHECK(rig.ingest.packets().pending == 16);
  rig.finish();
  CHECK(rig.ingest.refusal().empty());
  CHECK(rig.ingest.packets().decoded == 16);
  REQUIRE(rig.collector.sweeps.size() == 1);
  CHECK(rig.header(0).firings_received == 96);
  CHECK(rig.header(0).has(kPartialEnd));
}

TEST_CASE("only the first packets are held back, for 18 ms", "[assembly][packet_ingest]") {
  const PacketStream stream;
  Rig rig;
  rig.push(stream, 0, 63);
  CHECK(rig.ingest.packets().pending == 63);
  CHECK(rig.ingest.packets().decoded == 0);
  for (int i = 63; i < 500; ++i) {
    rig.push(stream, i, i + 1);
    REQUIRE(rig.ingest.packets().pending == 0);
    REQUIRE(rig.ingest.packets().decoded == static_cast<std::uint64_t>(i + 1));
  }
}

TEST_CASE("a silence is measured by the sensor's clock and turns count on", "[assembly][packet_ingest]") {
  for (const int missing : {180, 1000, 3000, 30'000}) {
    INFO(missing << " packets missing");
    const StreamSettings settings;
    const PacketStream stream(settings);
    Rig rig;
    double worst_deg = 0.0;
    std::int64_t origin_ns = 0;
    rig.collector.on_part = [&](const SweepPart& part) {
      if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
      worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, origin_ns));
    };
    rig.push(stream, 0, 1200);
    rig.push(stream, 1200 + missing, 2600 + missing);
    rig.finish();
    CHECK(worst_deg < 0.0105);
    CHECK(rig.ingest.packets().decoded == 2600);
    CHECK(rig.ingest.firings().lost == static_cast<std::uint64_t>(6 * missing));
    CHECK(rig.collector.received() == 6 * 2600);
    const auto& last = rig.collector.sweeps.back().header;
    CHECK(last.sequence == static_cast<std::uint64_t>((2600 + missing) * 6 / (1.0 / 480e-6)));
    CHECK(std::count_if(rig.collector.sweeps.begin(), rig.collector.sweeps.end(),
                        [](const auto& s) { return s.header.has(kAfterGap); }) == (missing > 700 ? 1 : 0));
  }
}

TEST_CASE("a sensor that is switched off and on is found again", "[assembly][packet_ingest]") {
  const PacketStream before;
  StreamSettings later{.rotation_hz = 15.0, .azimuth_deg = 77.0, .stamp_us = 2'000'000};
  later.arrival_ns += 20'000'000'000;
  const PacketStream after(later);
  Rig rig;
  double worst_deg = 0.0;
  std::int64_t origin_ns = 0;
  rig.push(before, 0, 1000);
  rig.collector.on_part = [&](const SweepPart& part) {
    const SweepHeader& h = part.sweep->header;
    if (origin_ns == 0 && !h.has(kAfterGap)) return;
    if (origin_ns == 0) origin_ns = h.start_ns - 7 * 288'000;  // seven packets convinced the clock
    worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, later, origin_ns));
  };
  rig.push(after, 0, 1000);
  rig.finish();
  CHECK(rig.ingest.clock_restarts() == 1);
  CHECK(rig.bad(PacketFault::kStamp) == 7);
  CHECK(rig.ingest.packets().decoded == 1993);
  CHECK(rig.ingest.firings().lost == 0);
  CHECK(rig.collector.received() == 6 * 1993);
  CHECK(worst_deg < 0.0105);
  CHECK(rig.ingest.rotation_hz() == Approx(15.0).epsilon(1e-3));
}

TEST_CASE("a head that leaps is followed from the first packet on", "[assembly][packet_ingest]") {
  const PacketStream before;
  StreamSettings settings;
  settings.azimuth_deg += 100.0;
  const PacketStream leapt(settings);
  Rig rig;
  rig.push(before, 0, 1000);
  double worst_deg = 0.0;
  std::int64_t leap_ns = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    const SweepHeader& h = part.sweep->header;
    if (leap_ns == 0 && !h.has(kAfterGap)) return;
    if (leap_ns == 0) leap_ns = h.start_ns;
    worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, leap_ns - 1000 * 288'000));
  };
  rig.push(leapt, 1000, 3000);
  rig.finish();
  CHECK(leap_ns != 0);
  CHECK(worst_deg < 0.0105);
  CHECK(rig.collector.received() == 18'000);
}

TEST_CASE("a packet of wrong azimuths delays the stream but not its order or angles",
          "[assembly][packet_ingest]") {
  const StreamSettings settings;
  const PacketStream stream(settings);
  Rig rig;
  std::int64_t origin_ns = 0;
  double worst_deg = 0.0;
  rig.collector.on_part = [&](const SweepPart& part) {
    if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
    worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, origin_ns));
  };
  for (int i = 0; i < 1500; ++i) {
    test::PacketBytes bytes = stream.packet(i);
    if (i == 900 || i == 30)
      for (std::size_t block = 0; block < 12; ++block)
        bytes[100 * block + 3] = static_cast<std::uint8_t>(block / 2);
    rig.push(bytes, stream.arrival_ns(i));
  }
  rig.finish();
  CHECK(worst_deg < 0.0105);
  CHECK(rig.ingest.packets().decoded == 1500);
  for (const auto& sweep : rig.collector.sweeps) CHECK_FALSE(sweep.header.has(kAfterGap));
}

TEST_CASE("a head at rest gives no sweeps, and says so", "[assembly][packet_ingest]") {
  StreamSettings standing{.rotation_hz = 0.0};
  const PacketStream stream(standing);
  Rig rig;
  rig.push(stream, 0, 500);
  CHECK(rig.ingest.rotation_hz() == 0.0);
  CHECK(rig.ingest.packets().decoded == 500);
  rig.finish();
  CHECK(rig.collector.sweeps.empty());
  CHECK_FALSE(rig.ingest.is_refused());
}

TEST_CASE("a stalled consumer costs whole rotations, all of them counted", "[assembly][packet_ingest]") {
  const PacketStream stream;
  Rig rig({}, 2);
  rig.collector.frees_at_once = false;
  rig.push(stream, 0, 4000);
  rig.finish();
  const AssemblyCounters& sweeps = rig.ingest.sweeps();
  CHECK(sweeps.no_free_sweep > 8);
  CHECK(sweeps.opened == sweeps.handed_on + sweeps.no_free_sweep);
  CHECK(rig.ingest.packets().decoded == 4000);
}

TEST_CASE("nothing on the packets' way allocates", "[assembly][packet_ingest]") {
  const PacketStream stream;
  struct Sink final : SweepExchange {
    Sweep* acquire() noexcept override { return ring.try_acquire(); }
    void hand_on(const SweepPart& part) noexcept override {
      if (part.last) ring.release(part.sweep);
    }
    SweepRing ring{2, kMaxColumns* kNumRings};
  } sink;
  PacketIngest ingest({}, {}, plain_calibration(), sink);
  std::vector<test::PacketBytes> packets;
  for (int i = 0; i < 1500; ++i)
    if (i % 30 != 7) packets.push_back(stream.packet(i));
  std::swap(packets[300], packets[301]);
  packets[500] = packets[499];
  packets[600][0] = 0;
  packets.erase(packets.begin() + 700, packets.begin() + 1000);
  const std::uint64_t before = test::news_so_far();
  for (const auto& bytes : packets) ingest.push({.payload = bytes, .arrival_ns = 0});
  ingest.finish();
  CHECK(test::news_so_far() == before);
  CHECK(ingest.sweeps().handed_on > 2);
  CHECK(ingest.packets().duplicate == 1);
}
