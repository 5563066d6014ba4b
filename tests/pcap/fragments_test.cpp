// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pcap/fragments.hpp"

#include <algorithm>
#include <memory>
#include <random>

#include "frames.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;
using pcap::FragmentTable;
using pcap::Frame;

namespace {

constexpr std::size_t kMaxBytes = 2056;

/// A table with what it counts.
struct Bench {
  std::unique_ptr<FragmentTable> table = std::make_unique<FragmentTable>(kMaxBytes);
  SourceCounters counters;

  Octets add(const Frame& piece, std::int64_t stamp_ns = 0) {
    const pcap::Bytes whole = table->add(piece, stamp_ns, counters);
    return {whole.begin(), whole.end()};
  }
};

/// The piece [from, to) of a datagram.
Frame piece(const Octets& datagram, std::size_t from, std::size_t to, std::uint32_t id = 1) {
  Frame frame;
  frame.kind = Frame::Kind::kFragment;
  frame.key.version = 4;
  frame.key.id = id;
  frame.payload = pcap::Bytes(datagram).subspan(from, to - from);
  frame.fragment_offset = static_cast<std::uint32_t>(from);
  frame.fragment_length = static_cast<std::uint32_t>(to - from);
  frame.more_fragments = to < datagram.size();
  return frame;
}

}  // namespace

TEST_CASE("pieces in any order make the datagram, once", "[pcap][fragments]") {
  std::mt19937 random(2);
  Bench bench;
  for (std::uint32_t round = 0; round < 500; ++round) {
    const Octets datagram = counting_payload(1 + random() % kMaxBytes, static_cast<std::uint8_t>(round));
    std::vector<Frame> pieces;
    for (std::size_t at = 0; at < datagram.size();) {
      const std::size_t to = std::min(datagram.size(), at + 8 * (1 + random() % 90));
      pieces.push_back(piece(datagram, at, to, round % 3));
      at = to;
    }
    std::shuffle(pieces.begin(), pieces.end(), random);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) REQUIRE(bench.add(pieces[i]).empty());
    REQUIRE(bench.add(pieces.back()) == datagram);
  }
  bench.table->finish(bench.counters);
  CHECK(bench.counters.received == 0);
}

TEST_CASE("datagrams that arrive interleaved are kept apart", "[pcap][fragments]") {
  Bench bench;
  const Octets a = counting_payload(1214, 1), b = counting_payload(1214, 2);
  CHECK(bench.add(piece(a, 0, 1000, 5)).empty());
  CHECK(bench.add(piece(b, 1000, 1214, 6)).empty());
  CHECK(bench.add(piece(a, 1000, 1214, 5)) == a);
  CHECK(bench.add(piece(b, 0, 1000, 6)) == b);
}

TEST_CASE("a piece that comes twice changes nothing", "[pcap][fragments]") {
  Bench bench;
  const Octets a = counting_payload(1214);
  CHECK(bench.add(piece(a, 0, 1000)).empty());
  CHECK(bench.add(piece(a, 0, 1000)).empty());
  CHECK(bench.add(piece(a, 1000, 1214)) == a);
  CHECK(bench.counters.received == 0);
}

TEST_CASE("pieces that overlap or end differently spoil the datagram", "[pcap][fragments]") {
  const Octets a = counting_payload(1214), shorter = counting_payload(800);
  for (const Frame& second : {piece(a, 496, 1104), piece(shorter, 496, 800)}) {
    Bench bench;
    CHECK(bench.add(piece(a, 0, 1000)).empty());
    CHECK(bench.add(second).empty());
    CHECK(bench.counters.malformed == 1);
    CHECK(bench.counters.balanced());
  }
  Bench bench;
  CHECK(bench.add(piece(shorter, 496, 800)).empty());
  CHECK(bench.add(piece(a, 1000, 1104)).empty());  // beyond the end that was announced
  CHECK(bench.counters.malformed == 1);
}

TEST_CASE("a datagram with an unrecorded part is truncated, not lost", "[pcap][fragments]") {
  Bench bench;
  const Octets a = counting_payload(1214);
  Frame cut = piece(a, 0, 1000);
  cut.payload = cut.payload.first(600);
  CHECK(bench.add(cut).empty());
  CHECK(bench.add(piece(a, 1000, 1214)).empty());
  CHECK(bench.counters.truncated == 1);
  CHECK(bench.counters.fragment_lost == 0);
  CHECK(bench.counters.balanced());
}

TEST_CASE("a datagram too long to keep is truncated", "[pcap][fragments]") {
  const Octets a = counting_payload(60000);
  Bench bench;
  for (std::size_t at = 0; at < a.size(); at += 1480)
    CHECK(bench.add(piece(a, at, std::min(a.size(), at + 1480))).empty());
  CHECK(bench.counters.truncated == 1);
  CHECK(bench.counters.received == 1);
}

TEST_CASE("the oldest unfinished datagram makes room for the newest", "[pcap][fragments]") {
  Bench bench;
  const Octets a = counting_payload(1214);
  const auto slots = static_cast<std::uint32_t>(FragmentTable::kSlots);
  for (std::uint32_t id = 0; id < slots + 3; ++id) CHECK(bench.add(piece(a, 0, 1000, id)).empty());
  CHECK(bench.counters.fragment_lost == 3);
  CHECK(bench.add(piece(a, 1000, 1214, slots + 2)) == a);
  CHECK(bench.add(piece(a, 1000, 1214, 3)) == a);
  CHECK(bench.add(piece(a, 1000, 1214, 2)).empty());
  bench.table->finish(bench.counters);
  CHECK(bench.counters.fragment_lost == 3 + slots - 2 + 1);
  CHECK(bench.counters.balanced());
}

TEST_CASE("an id used again later is another datagram", "[pcap][fragments]") {
  Bench bench;
  const Octets a = counting_payload(1214, 1), b = counting_payload(1214, 2);
  CHECK(bench.add(piece(a, 0, 1000), 0).empty());
  CHECK(bench.add(piece(b, 0, 1000), 19'000'000'000).empty());
  CHECK(bench.counters.fragment_lost == 1);
  CHECK(bench.add(piece(b, 1000, 1214), 19'000'000'001) == b);
}

TEST_CASE("any pieces are safe and accounted for", "[pcap][fragments]") {
  std::mt19937 random(3);
  const Octets bytes = counting_payload(3000);
  Bench bench;
  std::uint64_t whole = 0;
  for (int i = 0; i < 20000; ++i) {
    Frame frame = piece(bytes, 0, 8 * (1 + random() % 300), static_cast<std::uint32_t>(random() % 50));
    frame.fragment_offset =
        static_cast<std::uint32_t>(8 * (random() % 6 == 0 ? random() % 7000 : random() % 60));
    frame.more_fragments = random() % 2 == 0;
    if (random() % 9 == 0) frame.payload = frame.payload.first(random() % frame.payload.size());
    whole += bench.add(frame, static_cast<std::int64_t>(random()) * 1000).empty() ? 0U : 1U;
    REQUIRE(bench.counters.balanced());
  }
  bench.table->finish(bench.counters);
  CHECK(bench.counters.balanced());
  CHECK(whole > 0);
}
