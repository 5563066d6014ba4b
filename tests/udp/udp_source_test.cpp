// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/udp/udp_source.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "pago/core/error.hpp"
#include "support/alloc_guard.hpp"
#include "support/catch.hpp"
#include "support/udp_sender.hpp"

using namespace pago;

namespace {

const UdpEndpoint kAnyPort{"127.0.0.1", 0};

std::vector<std::uint8_t> payload(std::size_t size, std::uint8_t first) {
  std::vector<std::uint8_t> bytes(size, 7);
  bytes[0] = first;
  return bytes;
}

std::int64_t host_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Receives until `count` datagrams came, or for so long that they are not coming.
std::vector<Datagram> receive(UdpSource& source,
                              std::size_t count,
                              std::vector<std::vector<std::uint8_t>>& bytes) {
  std::vector<Datagram> all;
  for (int drains = 0; drains < 500 && all.size() < count; ++drains) {
    for (const Datagram& datagram : source.receive()) {
      bytes.emplace_back(datagram.payload.begin(), datagram.payload.end());
      all.push_back(datagram);
    }
  }
  return all;
}
std::size_t receive(UdpSource& source, std::size_t count) {
  std::vector<std::vector<std::uint8_t>> bytes;
  return receive(source, count, bytes).size();
}

std::string refusal(const std::function<void()>& create) {
  try {
    create();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("datagrams arrive whole, in order, with sender and arrival", "[udp]") {
  UdpSource source(kAnyPort);
  test::UdpSender sensor(source.port(), "127.0.0.43");
  // The kernel begins to stamp a moment after it was asked to; until then reading stamps.
  sensor.send(payload(1206, 0));
  receive(source, 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::int64_t before_ns = host_now_ns();
  for (std::uint8_t i = 0; i < 200; ++i) sensor.send(payload(1206, i));
  std::vector<std::vector<std::uint8_t>> bytes;
  const auto got = receive(source, 200, bytes);
  const std::int64_t after_ns = host_now_ns();
  REQUIRE(got.size() == 200);
  for (std::size_t i = 0; i < got.size(); ++i) {
    CHECK(bytes[i] == payload(1206, static_cast<std::uint8_t>(i)));
    CHECK(got[i].source_ipv4 == 0x7F00002B);
    CHECK(got[i].destination_port == source.port());
    CHECK(got[i].arrival_ns >= before_ns);
    CHECK(got[i].arrival_ns <= after_ns);
    if (i > 0) CHECK(got[i].arrival_ns >= got[i - 1].arrival_ns);
  }
  CHECK(source.counters().received == 201);
  CHECK(source.counters().delivered == 201);
  CHECK(source.counters().balanced());
  CHECK_FALSE(source.all_done());
  CHECK(source.complaint().empty());
}

TEST_CASE("nothing to receive is no end and no error", "[udp]") {
  UdpSource source(kAnyPort);
  for (int i = 0; i < 5; ++i) CHECK(source.receive().empty());
  CHECK_FALSE(source.all_done());
  CHECK(source.counters().received == 0);
}

TEST_CASE("another sender is filtered, an overlong datagram is counted as truncated", "[udp]") {
  UdpSource source(kAnyPort, {.port = 2368, .source_address = "127.0.0.43"});
  test::UdpSender sensor(source.port(), "127.0.0.43"), other(source.port(), "127.0.0.44");
  other.send(payload(1206, 1));
  sensor.send(payload(UdpSource::kMaxPayloadBytes + 1, 2));
  sensor.send(payload(UdpSource::kMaxPayloadBytes, 3));
  std::vector<std::vector<std::uint8_t>> bytes;
  REQUIRE(receive(source, 1, bytes).size() == 1);
  CHECK(bytes[0].size() == UdpSource::kMaxPayloadBytes);
  CHECK(bytes[0][0] == 3);
  const SourceCounters counters = source.counters();
  CHECK(counters.received == 3);
  CHECK(counters.filtered == 1);
  CHECK(counters.truncated == 1);
  CHECK(counters.balanced());
}

TEST_CASE("what the kernel drops is counted to the datagram", "[udp]") {
  UdpSource source(kAnyPort, {}, {.receive_buffer_bytes = 4096, .drain_interval_ms = 0.1});
  test::UdpSender sensor(source.port());
  std::size_t got = 0;
  for (int burst = 0; burst < 3; ++burst) {
    for (int i = 0; i < 300; ++i) sensor.send(payload(1206, 0));
    got += receive(source, 300);
  }
  // The kernel tells of its losses with the next datagram that it keeps.
  sensor.send(payload(1206, 0));
  got += receive(source, 1);
  CHECK(source.counters().kernel_dropped > 0);
  CHECK(got + source.counters().kernel_dropped == 901);
  CHECK(source.counters().balanced());
}

TEST_CASE("the buffer that was granted is told, and why it may be too small", "[udp]") {
  const UdpSource modest(kAnyPort, {}, {.receive_buffer_bytes = 65536, .drain_interval_ms = 2.0});
  CHECK(modest.receive_buffer_bytes() >= 65536);
  CHECK(modest.warnings().empty());
  // More than any host grants without privileges; with them it may be granted.
  const UdpSource greedy(kAnyPort, {}, {.receive_buffer_bytes = 256 << 20, .drain_interval_ms = 2.0});
  const bool is_granted = greedy.receive_buffer_bytes() / 2 >= 256 << 20;
  REQUIRE(greedy.warnings().size() == (is_granted ? 0U : 1U));
  if (!is_granted) CHECK(greedy.warnings()[0].find("rmem_max=268435456") != std::string::npos);
}

TEST_CASE("a port that is taken, a foreign address and nonsense are refused in words", "[udp]") {
  const UdpSource first(kAnyPort);
  const std::string taken = refusal([&] { UdpSource second({"127.0.0.1", first.port()}); });
  CHECK(taken.find("udp://127.0.0.1:" + std::to_string(first.port())) != std::string::npos);
  CHECK(taken.find("another program has the port") != std::string::npos);
  CHECK(refusal([] {
          UdpSource source({"192.0.2.1", 0});
        }).find("no interface of this host") != std::string::npos);
  CHECK(refusal([] {
          UdpSource source({"eth0", 0});
        }).find("'eth0' is not an IPv4 address") != std::string::npos);
  CHECK(refusal([] {
          UdpSource source(kAnyPort, {.port = 2368, .source_address = "sensor"});
        }).find("packets.source_address") != std::string::npos);
}

TEST_CASE("endpoints are read as users write them", "[udp]") {
  const auto read = [](const char* text) { return to_string(parse_udp_endpoint(text)); };
  CHECK(read("udp://:2368") == "udp://:2368");
  CHECK(read("udp://") == "udp://:2368");
  CHECK(read("udp://192.168.3.1") == "udp://192.168.3.1:2368");
  CHECK(read("udp://192.168.3.1:9000/") == "udp://192.168.3.1:9000");
  for (const char* wrong : {"udp://:port", "udp://:", "udp://:70000", "udp://:-1", "udp://:23 68"})
    CHECK(refusal([&] { parse_udp_endpoint(wrong); }).find("is no UDP port") != std::string::npos);
}

TEST_CASE("receiving calls the heap never", "[udp]") {
  UdpSource source(kAnyPort);
  test::UdpSender sensor(source.port());
  for (int i = 0; i < 150; ++i) sensor.send(payload(1206, 0));
  const test::AllocationGuard guard;
  std::size_t got = 0;
  for (int drains = 0; drains < 500 && got < 150; ++drains) got += source.receive().size();
  CHECK(guard.count() == 0);
  CHECK(got == 150);
}
