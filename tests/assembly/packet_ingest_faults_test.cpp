// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"
#include "support/new_counter.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("whatever is lost is counted to the packet, and nothing else suffers",
          "[assembly][packet_ingest]") {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    const StreamSettings settings{.rotation_hz = 10.0 + 0.3 * seed, .azimuth_deg = 33.0 * seed};
    const PacketStream stream(settings);
    IngestRig rig;
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

TEST_CASE("a silence is measured by the sensor's clock and turns count on", "[assembly][packet_ingest]") {
  for (const int missing : {180, 1000, 3000, 30'000}) {
    INFO(missing << " packets missing");
    const StreamSettings settings;
    const PacketStream stream(settings);
    IngestRig rig;
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
  // From stamp 1,799 s: sensor time leaps backwards, or forwards.
  const std::uint32_t stamp_us = GENERATE(2'000'000U, 2'500'000'000U);
  const PacketStream before;
  StreamSettings later{.rotation_hz = 15.0, .azimuth_deg = 77.0, .stamp_us = stamp_us};
  later.arrival_ns += 20'000'000'000;
  const PacketStream after(later);
  IngestRig rig;
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
  for (std::size_t i = 1; i < rig.collector.sweeps.size(); ++i)
    CHECK(rig.header(i).sequence == i);  // how many rotations it missed, nobody knows
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
  IngestRig rig;
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
  IngestRig rig;
  std::int64_t origin_ns = 0;
  double worst_deg = 0.0;
  rig.collector.on_part = [&](const SweepPart& part) {
    if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
    worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, settings, origin_ns));
  };
  for (int i = 0; i < 1500; ++i) {
    PacketBytes bytes = stream.packet(i);
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
  IngestRig rig;
  rig.push(stream, 0, 500);
  CHECK(rig.ingest.rotation_hz() == 0.0);
  CHECK(rig.ingest.packets().decoded == 500);
  rig.finish();
  CHECK(rig.collector.sweeps.empty());
  CHECK_FALSE(rig.ingest.is_refused());
}

TEST_CASE("a stalled consumer costs whole rotations, all of them counted", "[assembly][packet_ingest]") {
  const PacketStream stream;
  IngestRig rig({}, 2);
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
  std::vector<PacketBytes> packets;
  for (int i = 0; i < 1500; ++i)
    if (i % 30 != 7) packets.push_back(stream.packet(i));
  std::swap(packets[300], packets[301]);
  packets[500] = packets[499];
  packets[600][0] = 0;
  packets.erase(packets.begin() + 700, packets.begin() + 1000);
  const std::uint64_t before = news_so_far();
  for (const auto& bytes : packets) ingest.push({.payload = bytes, .arrival_ns = 0});
  ingest.finish();
  CHECK(news_so_far() == before);
  CHECK(ingest.sweeps().handed_on > 2);
  CHECK(ingest.packets().duplicate == 1);
}
