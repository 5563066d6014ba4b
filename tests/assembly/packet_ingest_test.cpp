// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_ingest.hpp"

#include <algorithm>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

TEST_CASE("from 5 to 20 Hz every packet is used and every return points where the head did",
          "[assembly][packet_ingest]") {
  for (const double rate_hz : {5.0, 7.3, 9.6517, 10.0, 14.9, 20.0}) {
    INFO(rate_hz << " Hz");
    const StreamSettings settings{.rotation_hz = rate_hz, .azimuth_deg = 200.0};
    const PacketStream stream(settings);
    IngestRig rig;
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
  IngestRig rig;
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
  Collector first, last;
  Hdl64Config sensor;
  PacketIngest by_first({}, sensor, plain_calibration(), first);
  sensor.packet_stamp = PacketStamp::kLastFiring;
  PacketIngest by_last({}, sensor, plain_calibration(), last);
  for (int i = 0; i < 400; ++i) {
    const PacketBytes bytes = stream.packet(i);
    by_first.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
    by_last.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
  }
  REQUIRE(first.sweeps.size() == 1);
  CHECK(first.sweeps[0].header.start_ns - last.sweeps.at(0).header.start_ns == 288'000);
  CHECK(first.sweeps[0].header.num_columns == last.sweeps[0].header.num_columns);
}

TEST_CASE("doubled and overtaken packets leave no trace but in the counters", "[assembly][packet_ingest]") {
  const PacketStream stream;
  IngestRig orderly, disorderly;
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

TEST_CASE("malformed datagrams are counted by reason and noted in their sweep", "[assembly][packet_ingest]") {
  const PacketStream stream;
  IngestRig rig;
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
  IngestRig rig;
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
  CHECK(rig.ingest.packets().received == 200);
  CHECK(rig.bad(PacketFault::kOtherSensor) == 200);
  CHECK(rig.ingest.packets().bad_total() == 200);
  CHECK(rig.ingest.firings().expected == 0);
}

TEST_CASE("what was refused may be replaced: asked to, the ingest looks again", "[assembly][packet_ingest]") {
  IngestRig rig;
  PacketBuilder builder;
  for (int block = 0; block < hdl64::kBlocks; ++block) builder.flag(block, hdl64::kUpperBlock);
  for (int i = 0; i < 100; ++i) rig.push(builder.bytes(), 553'000 * i);
  REQUIRE(rig.ingest.is_refused());
  rig.push(PacketStream(), 0, 50);
  CHECK(rig.ingest.packets().decoded == 0);
  rig.ingest.probe_again();
  CHECK_FALSE(rig.ingest.is_refused());
  rig.push(PacketStream(), 50, 1000);
  rig.finish();
  CHECK(rig.ingest.refusal().empty());
  CHECK(rig.ingest.packets().decoded == 950);
  CHECK(rig.ingest.packets().bad_total() == 150);
  CHECK(rig.ingest.firings().expected == 6 * 950);
}

TEST_CASE("a silence ends the stream, told of it early or not, the sweeps are the same",
          "[assembly][packet_ingest]") {
  constexpr int kMissing = 1100;  // 317 ms
  const bool is_told = GENERATE(false, true);
  const PacketStream stream;
  IngestRig rig;
  rig.push(stream, 0, 800);  // two whole rotations and a third of one
  CHECK(rig.collector.sweeps.size() == 2);
  if (is_told) {
    rig.ingest.note_silence();
    CHECK(rig.collector.sweeps.size() == 3);
    rig.ingest.note_silence();
  }
  rig.push(stream, 800 + kMissing, 2800 + kMissing);
  rig.finish();
  REQUIRE(rig.collector.sweeps.size() == 10);
  CHECK(rig.header(2).has(kPartialEnd));
  CHECK_FALSE(rig.header(2).is_posed());
  CHECK(rig.header(3).has(kPartialStart));
  CHECK(rig.header(3).has(kAfterGap));
  for (std::size_t i = 4; i < 9; ++i) CHECK(rig.header(i).flags == 0);
  CHECK(rig.header(2).firings_received + rig.header(1).firings_received + rig.header(0).firings_received ==
        6 * 800);
  CHECK(rig.ingest.firings().lost == 6 * kMissing);
  CHECK(rig.ingest.packets().decoded == 2800);
}

TEST_CASE("a pause of less than a third of a second is a gap inside the stream",
          "[assembly][packet_ingest]") {
  const PacketStream stream;
  IngestRig rig;
  rig.push(stream, 0, 800);
  rig.push(stream, 1800, 2800);  // 288 ms later
  rig.finish();
  for (std::size_t i = 0; i + 1 < rig.collector.sweeps.size(); ++i) CHECK(rig.header(i).is_posed());
}

TEST_CASE("a stream too short to be recognised is refused with its length", "[assembly][packet_ingest]") {
  IngestRig rig;
  rig.push(PacketStream(), 0, 15);
  CHECK_FALSE(rig.ingest.is_refused());
  CHECK(rig.ingest.refusal().empty());
  rig.finish();
  CHECK(rig.ingest.is_refused());
  CHECK_THAT(rig.ingest.refusal(), Catch::Contains("15 packets"));
  CHECK(rig.collector.sweeps.empty());
}

TEST_CASE("a stream of 16 packets is enough", "[assembly][packet_ingest]") {
  IngestRig rig;
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
  IngestRig rig;
  rig.push(stream, 0, 63);
  CHECK(rig.ingest.packets().pending == 63);
  CHECK(rig.ingest.packets().decoded == 0);
  for (int i = 63; i < 500; ++i) {
    rig.push(stream, i, i + 1);
    REQUIRE(rig.ingest.packets().pending == 0);
    REQUIRE(rig.ingest.packets().decoded == static_cast<std::uint64_t>(i + 1));
  }
}
