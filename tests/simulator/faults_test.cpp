// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/faults.hpp"

#include <cstring>
#include <set>

#include "drivers/simulator/head.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::simulator;

namespace {

constexpr std::int64_t kStart_ns = 1'772'446'500'000'000'000;

/// Packets that say their own number, sent the way; their numbers in the order in which they arrive.
std::vector<SentPacket> sent(const SimulatorFaults& faults, int packets) {
  FaultyWay way(faults, kStart_ns, 7);
  std::vector<SentPacket> arrived;
  SimulatedPacket packet;
  for (int i = 0; i < packets; ++i) {
    std::memcpy(packet.bytes.data(), &i, sizeof i);
    packet.time_ns = kStart_ns + 288'000LL * i;
    packet.arrival_ns = packet.time_ns + 400'000;
    way.pass(packet, arrived);
  }
  way.finish(arrived);
  return arrived;
}

int number_of(const SentPacket& packet) {
  int i = 0;
  std::memcpy(&i, packet.bytes.data(), sizeof i);
  return i;
}

std::set<int> numbers_of(const std::vector<SentPacket>& packets) {
  std::set<int> numbers;
  for (const SentPacket& packet : packets) numbers.insert(number_of(packet));
  return numbers;
}

std::uint32_t stamp_of(const SentPacket& packet) {
  std::uint32_t stamp_us = 0;
  std::memcpy(&stamp_us, packet.bytes.data() + 1200, sizeof stamp_us);
  return stamp_us;
}

}  // namespace

TEST_CASE("without faults every packet arrives once, as it was sent", "[simulator][faults]") {
  const auto arrived = sent({}, 200);
  REQUIRE(arrived.size() == 200);
  for (int i = 0; i < 200; ++i) {
    REQUIRE(number_of(arrived[static_cast<std::size_t>(i)]) == i);
    REQUIRE(arrived[static_cast<std::size_t>(i)].payload().size() == hdl64::kPacketBytes);
  }
}

TEST_CASE("losses, copies and late packets come in the parts asked for", "[simulator][faults]") {
  constexpr int kPackets = 20'000;
  CHECK(static_cast<double>(sent({.lost = 0.1}, kPackets).size()) == Approx(18'000).epsilon(0.02));
  CHECK(static_cast<double>(sent({.duplicated = 0.1}, kPackets).size()) == Approx(22'000).epsilon(0.02));
  // 5.76 s with a burst of 10 to 100 packets every tenth of a second.
  const auto after_bursts = sent({.bursts_per_min = 600.0}, kPackets);
  CHECK(static_cast<double>(kPackets) - static_cast<double>(after_bursts.size()) ==
        Approx(57.6 * 55.0).epsilon(0.4));

  const auto shuffled = sent({.reordered = 0.1}, kPackets);
  CHECK(static_cast<int>(numbers_of(shuffled).size()) == kPackets);
  int late = 0, latest = 0;
  for (std::size_t i = 1; i < shuffled.size(); ++i) {
    const int back = number_of(shuffled[i - 1]) - number_of(shuffled[i]);
    late += back > 0 ? 1 : 0;
    latest = std::max(latest, back);
    REQUIRE(shuffled[i].arrival_ns > shuffled[i - 1].arrival_ns);
  }
  CHECK(late == Approx(2000).epsilon(0.3));
  CHECK(latest <= 3);
}

TEST_CASE("packets are damaged in the parts asked for", "[simulator][faults]") {
  constexpr int kPackets = 5000;
  const auto whole = sent({}, kPackets);
  const auto differing = [&](const std::vector<SentPacket>& packets, std::size_t from, std::size_t to) {
    int count = 0;
    for (std::size_t i = 0; i < packets.size(); ++i)
      count += std::equal(packets[i].bytes.begin() + from, packets[i].bytes.begin() + to,
                          whole[i].bytes.begin() + from)
                   ? 0
                   : 1;
    return count;
  };
  CHECK(differing(sent({.corrupted = 0.2}, kPackets), 0, hdl64::kPacketBytes) == Approx(1000).epsilon(0.1));
  CHECK(differing(sent({.azimuth_glitches = 0.2}, kPackets), 0, hdl64::kPacketBytes) ==
        Approx(1000).epsilon(0.1));
  int cut = 0;
  for (const SentPacket& packet : sent({.truncated = 0.2}, kPackets))
    cut += packet.payload().size() < hdl64::kPacketBytes ? 1 : 0;
  CHECK(cut == Approx(1000).epsilon(0.1));
}

TEST_CASE("a pause is silent, and a power cycle begins stamps anew", "[simulator][faults]") {
  constexpr int kPackets = 25'000;  // 7.2 s
  const auto paused = sent({.pause_at_s = 1.0}, kPackets);
  CHECK(kPackets - static_cast<int>(paused.size()) == Approx(1.5 / 288e-6).margin(2));
  const auto cycled = sent({.power_cycle_at_s = 1.0}, kPackets);
  CHECK(kPackets - static_cast<int>(cycled.size()) == Approx(4.0 / 288e-6).margin(2));
  CHECK(stamp_of(cycled.back()) == Approx((7.2 - 5.0) * 1e6).margin(1000));
}

TEST_CASE("a head that stops turns on from where it stood", "[simulator][faults]") {
  const Head steady(10.0), stopping(10.0, 3.0);
  CHECK(stopping.revolutions(2.9) == steady.revolutions(2.9));
  CHECK(stopping.revolutions(4.0) == steady.revolutions(3.0));
  CHECK(stopping.rate_rev_s(4.0) == 0.0);
  CHECK(stopping.revolutions(6.0) == Approx(steady.revolutions(4.0)));
  for (const double turns : {12.0, 30.0, 35.5, 50.0})
    CHECK(stopping.revolutions(stopping.time_at_s(turns)) == Approx(turns));
}
