// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_sequencer.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "support/catch.hpp"
#include "support/packet_builder.hpp"

using namespace pago;
using Verdict = PacketSequencer::Verdict;

namespace {

constexpr std::int64_t kOrigin = 1'790'000'000'000'000'000;

/// Packets that know their number: it is in the azimuth, and in the time.
class Packets {
 public:
  StampedPacket operator[](int number) {
    auto [at, is_new] = made_.try_emplace(number);
    if (is_new) at->second = test::PacketBuilder().azimuths_cdeg(number % 30'000, 0).bytes();
    return {at->second, kOrigin + number * hdl64::kPacketPeriod_ns, kOrigin + number};
  }

 private:
  std::map<int, test::PacketBytes> made_;
};

/// Offers packets in the order of `numbers`; returns the numbers that came out, in order.
struct Outcome {
  std::vector<int> used;
  int duplicates = 0, late = 0;
};
Outcome offer_all(PacketSequencer& sequencer, const std::vector<int>& numbers) {
  Packets packets;
  Outcome outcome;
  const auto use = [&](const StampedPacket& packet) {
    const int number = packet.view().azimuth_cdeg(0);
    CHECK(packet.time_ns == kOrigin + number * hdl64::kPacketPeriod_ns);
    CHECK(packet.arrival_ns == kOrigin + number);
    outcome.used.push_back(number);
  };
  for (const int number : numbers) {
    const StampedPacket packet = packets[number];
    switch (sequencer.offer(packet)) {
      case Verdict::kNext:
        use(packet);
        break;
      case Verdict::kHeld:
        break;
      case Verdict::kDuplicate:
        ++outcome.duplicates;
        break;
      case Verdict::kLate:
        ++outcome.late;
        break;
    }
    while (const auto held = sequencer.take()) use(*held);
  }
  while (const auto held = sequencer.take_regardless()) use(*held);
  return outcome;
}

std::vector<int> range(int begin, int end) {
  std::vector<int> numbers;
  for (int i = begin; i < end; ++i) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST_CASE("packets in order pass at once and uncopied", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  Packets packets;
  for (int i = 0; i < 100; ++i) {
    const StampedPacket packet = packets[i];
    REQUIRE(sequencer.offer(packet) == Verdict::kNext);
    REQUIRE_FALSE(sequencer.take());
    REQUIRE(sequencer.held() == 0);
  }
  CHECK(sequencer.firings().expected == 600);
  CHECK(sequencer.firings().decoded == 600);
  CHECK(sequencer.firings().lost == 0);
  CHECK(sequencer.reordered() == 0);
}

TEST_CASE("stamps that jitter by a quarter of a period are in order", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  Packets packets;
  for (int i = 0; i < 100; ++i) {
    StampedPacket packet = packets[i];
    packet.time_ns += (i % 3 - 1) * hdl64::kPacketPeriod_ns / 4;
    REQUIRE(sequencer.offer(packet) == Verdict::kNext);
  }
  CHECK(sequencer.firings().lost == 0);
}

TEST_CASE("a swapped pair is put right as soon as it is whole", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  Packets packets;
  CHECK(sequencer.offer(packets[0]) == Verdict::kNext);
  CHECK(sequencer.offer(packets[2]) == Verdict::kHeld);
  CHECK_FALSE(sequencer.take());
  CHECK(sequencer.offer(packets[1]) == Verdict::kNext);
  const auto held = sequencer.take();
  REQUIRE(held);
  CHECK(held->view().azimuth_cdeg(0) == 2);
  CHECK_FALSE(sequencer.take());
  CHECK(sequencer.reordered() == 1);
  CHECK(sequencer.firings().lost == 0);
}

TEST_CASE("a lost packet costs a delay of four packets and no more", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  Packets packets;
  sequencer.offer(packets[0]);
  for (int i = 2; i <= 5; ++i) {
    CHECK(sequencer.offer(packets[i]) == Verdict::kHeld);
    CHECK_FALSE(sequencer.take());
  }
  CHECK(sequencer.offer(packets[6]) == Verdict::kHeld);
  for (int i = 2; i <= 6; ++i) {
    const auto held = sequencer.take();
    REQUIRE(held);
    CHECK(held->view().azimuth_cdeg(0) == i);
  }
  CHECK(sequencer.offer(packets[7]) == Verdict::kNext);
  CHECK(sequencer.offer(packets[1]) == Verdict::kLate);
  CHECK(sequencer.firings().lost == 6);
  CHECK(sequencer.firings().expected == 48);
  CHECK(sequencer.firings().balanced());
}

TEST_CASE("a packet that was used or is held is known again", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  Packets packets;
  sequencer.offer(packets[0]);
  CHECK(sequencer.offer(packets[0]) == Verdict::kDuplicate);
  sequencer.offer(packets[1]);
  CHECK(sequencer.offer(packets[0]) == Verdict::kDuplicate);
  CHECK(sequencer.offer(packets[3]) == Verdict::kHeld);
  CHECK(sequencer.offer(packets[3]) == Verdict::kDuplicate);
  StampedPacket other = packets[9];  // same time, other azimuth: another sensor's, or an old one
  other.time_ns = packets[1].time_ns;
  CHECK(sequencer.offer(other) == Verdict::kLate);
}

TEST_CASE("without a window everything newer passes", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(0);
  const Outcome outcome = offer_all(sequencer, {0, 1, 3, 2, 4, 4, 8});
  CHECK(outcome.used == std::vector<int>{0, 1, 3, 4, 8});
  CHECK(outcome.late == 1);
  CHECK(outcome.duplicates == 1);
  CHECK(sequencer.firings().lost == 24);
  CHECK(sequencer.held() == 0);
}

TEST_CASE("the end of the stream frees what is held", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  CHECK(offer_all(sequencer, {5, 8, 7, 10}).used == std::vector<int>{5, 7, 8, 10});
  CHECK(sequencer.firings().lost == 12);
  CHECK(sequencer.firings().balanced());
}

TEST_CASE("a new count of time is not a gap", "[assembly][packet_sequencer]") {
  PacketSequencer sequencer(4);
  offer_all(sequencer, {1000, 1001});
  sequencer.restart();
  CHECK(offer_all(sequencer, {0, 1, 2}).used == std::vector<int>{0, 1, 2});
  CHECK(sequencer.firings().expected == 30);
  CHECK(sequencer.firings().lost == 0);
}

TEST_CASE("whatever is lost, doubled and swapped within the window, order and counts are exact",
          "[assembly][packet_sequencer]") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<int> sent = range(0, 400), expected;
    std::vector<std::pair<int, int>> keyed;  // place in the stream, number
    int doubled = 0;
    for (const int number : sent) {
      // The first and the last arrive for certain, so that nothing is lost outside.
      if (number != 0 && number != 399 && random() % 12 == 0) continue;
      expected.push_back(number);
      // Up to two places late: never overtaken by more than the window.
      const int delay = number != 0 && random() % 5 == 0 ? static_cast<int>(random() % 3) : 0;
      keyed.emplace_back(2 * (number + delay) + (delay != 0), number);
      if (random() % 9 == 0) {
        keyed.emplace_back(keyed.back().first + static_cast<int>(random() % 4), number);
        ++doubled;
      }
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](auto& a, auto& b) { return a.first < b.first; });
    std::vector<int> offered;
    for (const auto& [place, number] : keyed) offered.push_back(number);
    PacketSequencer sequencer(4);
    const Outcome outcome = offer_all(sequencer, offered);
    INFO("seed " << seed);
    REQUIRE(outcome.used == expected);
    REQUIRE(outcome.duplicates == doubled);
    REQUIRE(outcome.late == 0);
    REQUIRE(sequencer.firings().expected == 2400);
    REQUIRE(sequencer.firings().lost == 6 * (400 - expected.size()));
    REQUIRE(sequencer.firings().balanced());
  }
}

TEST_CASE("any order at all gives rising times and balanced counts", "[assembly][packet_sequencer]") {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    std::vector<int> offered = range(0, 300);
    std::shuffle(offered.begin(), offered.end(), random);
    PacketSequencer sequencer(static_cast<int>(seed % 7));
    const Outcome outcome = offer_all(sequencer, offered);
    REQUIRE(std::is_sorted(outcome.used.begin(), outcome.used.end()));
    REQUIRE(outcome.used.size() + static_cast<std::size_t>(outcome.late + outcome.duplicates) == 300);
    REQUIRE(outcome.duplicates == 0);
    REQUIRE(sequencer.firings().balanced());
    REQUIRE(sequencer.firings().decoded == 6 * outcome.used.size());
  }
}
