// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <thread>
#include <vector>

#include "pago/pipeline/paced_source.hpp"
#include "pago/pipeline/packet_inbox.hpp"
#include "pago/platform/clock.hpp"
#include "support/alloc_guard.hpp"
#include "support/catch.hpp"
#include "support/street_packets.hpp"

using namespace pago;

namespace {

std::vector<test::PacketBytes> numbered_packets(std::size_t count) {
  std::vector<test::PacketBytes> packets(count);
  for (std::size_t i = 0; i < count; ++i) packets[i][0] = static_cast<std::uint8_t>(i);
  return packets;
}

}  // namespace

TEST_CASE("paced, a recording's datagrams come in order, when they are due, and arrive now",
          "[pipeline][paced_source]") {
  const auto packets = numbered_packets(200);  // 57 ms
  const double speed = GENERATE(1.0, 4.0);
  test::MemorySource recorded(packets, 17);
  PacedSource source(recorded, speed);
  const std::int64_t start_ns = platform::monotonic_ns(), started_ns = platform::realtime_ns();
  std::size_t got = 0;
  std::int64_t first_arrival_ns = 0;
  while (!source.all_done()) {
    for (const Datagram& datagram : source.receive()) {
      if (got == 0) first_arrival_ns = datagram.arrival_ns;
      CHECK(datagram.payload[0] == static_cast<std::uint8_t>(got));
      CHECK(datagram.arrival_ns - first_arrival_ns ==
            static_cast<std::int64_t>(static_cast<double>(got) * 288'000.0 / speed));
      CHECK(datagram.arrival_ns <= platform::realtime_ns());
      ++got;
    }
    CHECK(source.counters().delivered == got);
    CHECK(source.counters().balanced());
  }
  CHECK(got == 200);
  CHECK(first_arrival_ns >= started_ns);
  CHECK(platform::monotonic_ns() - start_ns >= static_cast<std::int64_t>(199 * 288'000 / speed));
  CHECK(source.worst_lateness_ns() > 0);
}

TEST_CASE("what is submitted comes out in order, whole, and then it ends", "[pipeline][packet_inbox]") {
  const auto packets = numbered_packets(1000);
  PacketInbox inbox(2048);
  std::thread submitter([&] {
    for (std::size_t i = 0; i < packets.size(); ++i) {
      inbox.submit(packets[i], static_cast<std::int64_t>(i));
      if (i % 50 == 0) std::this_thread::yield();
    }
    inbox.close();
  });
  std::size_t got = 0, wrong = 0;
  while (!inbox.all_done())
    for (const Datagram& datagram : inbox.receive()) {
      const bool is_right = datagram.arrival_ns == static_cast<std::int64_t>(got) &&
                            datagram.payload.size() == hdl64::kPacketBytes &&
                            datagram.payload[0] == packets[got][0];
      wrong += is_right ? 0U : 1U;
      ++got;
    }
  submitter.join();
  CHECK(got == 1000);
  CHECK(wrong == 0);
  CHECK(inbox.counters().delivered == 1000);
  CHECK(inbox.counters().balanced());
}

TEST_CASE("an inbox that is full, or a packet too long, says no and counts", "[pipeline][packet_inbox]") {
  const auto packets = numbered_packets(1);
  const std::vector<std::uint8_t> long_one(PacketInbox::kMaxPayloadBytes + 1);
  PacketInbox inbox(4);
  for (int i = 0; i < 4; ++i) CHECK(inbox.submit(packets[0], i));
  CHECK_FALSE(inbox.submit(packets[0], 4));
  CHECK_FALSE(inbox.submit(long_one, 5));
  inbox.close();
  std::size_t got = 0;
  while (!inbox.all_done()) got += inbox.receive().size();
  CHECK(got == 4);
  CHECK(inbox.counters().kernel_dropped == 1);
  CHECK(inbox.counters().truncated == 1);
  CHECK(inbox.counters().balanced());
}

TEST_CASE("submitting and receiving call the heap never", "[pipeline][packet_inbox]") {
  const auto packets = numbered_packets(100);
  PacketInbox inbox(128);
  const test::AllocationGuard guard;
  for (const auto& packet : packets) inbox.submit(packet, 0);
  inbox.receive();
  CHECK(guard.count() == 0);
}
