// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pcap/frame.hpp"

#include <algorithm>
#include <memory>
#include <random>

#include "frames.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;
using pcap::Frame;
using pcap::LinkType;
using Kind = pcap::Frame::Kind;

namespace {

bool equal(OctetView a, OctetView b) {
  return std::ranges::equal(a, b);
}

/// Parses a copy that ends exactly where its heap block does, so that the sanitizer sees one byte too many.
Kind parse_exact(LinkType link, OctetView bytes) {
  const auto copy = std::make_unique<std::uint8_t[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), copy.get());
  const Frame frame = pcap::parse_frame(link, {copy.get(), bytes.size()});
  const std::uint8_t* const begin = frame.payload.data();
  if (!frame.payload.empty())
    REQUIRE((begin >= copy.get() && begin + frame.payload.size() <= copy.get() + bytes.size()));
  return frame.kind;
}

Frame parse_ip(OctetView bytes) {
  return pcap::parse_frame(LinkType::kRawIp, bytes);
}

}  // namespace

TEST_CASE("a datagram is found behind every carrier", "[pcap][frame]") {
  for (const std::size_t size : {0U, 1U, 1206U, 2048U}) {
    const Octets payload = counting_payload(size);
    for (const Carrier& carrier : carriers(payload)) {
      INFO(carrier.name << ", " << size << " bytes");
      const Frame frame = pcap::parse_frame(carrier.link, carrier.frame);
      CHECK(frame.kind == Kind::kUdp);
      CHECK(equal(frame.payload, payload));
      CHECK(frame.source_port == 443);
      CHECK(frame.destination_port == 2368);
    }
  }
}

TEST_CASE("the sender of IPv4 is told, that of IPv6 is not", "[pcap][frame]") {
  const Octets datagram = udp(counting_payload(10));
  CHECK(parse_ip(ipv4(datagram)).source_ipv4 == 0xC0A8032B);
  CHECK(parse_ip(ipv6(datagram)).source_ipv4 == 0);
}

TEST_CASE("a record that ends before its headers say is short, wherever it is cut", "[pcap][frame]") {
  for (const Carrier& carrier : carriers(counting_payload(100))) {
    INFO(carrier.name);
    const std::size_t padding = carrier.name == "Ethernet, padded" ? 6 : 0;
    for (std::size_t n = 0; n < carrier.frame.size() - padding; ++n) {
      INFO("cut after " << n);
      CHECK(parse_exact(carrier.link, OctetView(carrier.frame).first(n)) == Kind::kShort);
    }
    CHECK(parse_exact(carrier.link, carrier.frame) == Kind::kUdp);
  }
}

TEST_CASE("any damaged record is safe to parse", "[pcap][frame]") {
  std::mt19937 random(1);
  std::uint64_t by_kind[5] = {};
  for (int round = 0; round < 300; ++round)
    for (const Carrier& carrier : carriers(counting_payload(60))) {
      Octets frame = carrier.frame;
      for (int flips = 0; flips < 1 + round % 4; ++flips)
        frame[random() % frame.size()] = static_cast<std::uint8_t>(random());
      frame.resize(random() % 4 == 0 ? random() % frame.size() : frame.size());
      ++by_kind[static_cast<std::size_t>(parse_exact(carrier.link, frame))];
    }
  for (const std::uint64_t n : by_kind) CHECK(n > 0);
}

TEST_CASE("other traffic is told apart from damage", "[pcap][frame]") {
  const auto kind = [](LinkType link, const Octets& bytes) { return pcap::parse_frame(link, bytes).kind; };
  CHECK(kind(LinkType::kEthernet, ethernet(Octets(46, 0), 0x0806)) == Kind::kOther);  // ARP
  CHECK(kind(LinkType::kEthernet, ethernet(Octets(46, 0), 0x002E)) == Kind::kOther);  // 802.3 length
  CHECK(kind(LinkType::kRawIp, ipv4(Octets(20, 0), {}, {}, {}, 6)) == Kind::kOther);  // TCP
  CHECK(kind(LinkType::kRawIp, ipv6(Octets(20, 0), 58)) == Kind::kOther);             // ICMPv6
  CHECK(kind(LinkType::kRawIp, ipv6(Octets(20, 0), 59)) == Kind::kOther);             // nothing follows
  CHECK(kind(LinkType::kLoopback, Octets{0, 0, 0, 7, 1, 2, 3}) == Kind::kOther);      // not IP
  CHECK(kind(LinkType::kRawIp, Octets{0x50, 0, 0, 0}) == Kind::kMalformed);           // no IP version
  CHECK(kind(LinkType::kEthernet, ethernet(ipv6(Octets(8, 0)), 0x0800)) == Kind::kMalformed);  // not IPv4
  CHECK(kind(LinkType::kEthernet, ethernet(ipv4(udp({})), 0x86DD)) != Kind::kUdp);             // not IPv6
}

TEST_CASE("lengths that contradict each other are malformed", "[pcap][frame]") {
  const Octets good = ipv4(udp(counting_payload(32)));
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Octets bytes = good;
    bytes[at] = value;
    return parse_ip(bytes).kind;
  };
  CHECK(with(0, 0x44) == Kind::kMalformed);  // header of 16 bytes
  CHECK(with(3, 19) == Kind::kMalformed);    // total less than the header
  CHECK(with(3, 24) == Kind::kMalformed);    // no room for a UDP header
  CHECK(with(3, 40) == Kind::kMalformed);    // UDP longer than its packet
  CHECK(with(25, 7) == Kind::kMalformed);    // UDP shorter than its header
  CHECK(with(25, 41) == Kind::kMalformed);   // UDP longer than its packet
  CHECK(with(25, 39) == Kind::kUdp);         // trailing byte after UDP: legal
  CHECK(with(3, 61) == Kind::kUdp);          // ... also where it was not captured
  CHECK(parse_ip(ipv6(Octets(7, 0))).kind == Kind::kMalformed);
}

TEST_CASE("a UDP checksum is not verified", "[pcap][frame]") {
  Octets bytes = ipv4(udp(counting_payload(32)));
  bytes[26] = 0xBA;
  bytes[27] = 0xD1;
  CHECK(parse_ip(bytes).kind == Kind::kUdp);
}

TEST_CASE("pieces of a datagram carry where they belong", "[pcap][frame]") {
  const Octets body = counting_payload(64);
  const Octets v4_bytes = ipv4(body, {}, {.id = 77, .offset = 128, .more = true});
  const Frame v4 = parse_ip(v4_bytes);
  CHECK(v4.kind == Kind::kFragment);
  CHECK(v4.key.id == 77);
  CHECK(v4.fragment_offset == 128);
  CHECK(v4.fragment_length == 64);
  CHECK(v4.more_fragments);
  CHECK(equal(v4.payload, body));

  const Octets v6_bytes = ipv6(extension(ipv6_fragment(body, {.id = 77, .offset = 128}), 44), 60);
  const Frame v6 = parse_ip(v6_bytes);
  CHECK(v6.kind == Kind::kFragment);
  CHECK(v6.fragment_offset == 128);
  CHECK_FALSE(v6.more_fragments);
  CHECK(equal(v6.payload, body));
  CHECK_FALSE(v6.key == v4.key);

  Octets cut = ipv4(body, {}, {.id = 77, .more = true});
  cut.resize(50);
  const Frame piece = parse_ip(cut);
  CHECK(piece.kind == Kind::kFragment);
  CHECK(piece.fragment_length == 64);
  CHECK(piece.payload.size() == 30);
}

TEST_CASE("impossible pieces are malformed", "[pcap][frame]") {
  CHECK(parse_ip(ipv4(Octets(63, 0), {}, {.more = true})).kind == Kind::kMalformed);
  CHECK(parse_ip(ipv4(Octets(0, 0), {}, {.offset = 8})).kind == Kind::kMalformed);
  CHECK(parse_ip(ipv4(Octets(64, 0), {}, {.offset = 65528})).kind == Kind::kMalformed);
}

TEST_CASE("only link layers that carry IP are taken", "[pcap][frame]") {
  for (const int dlt : {0, 1, 12, 14, 101, 108, 113, 228, 229, 276}) CHECK(pcap::link_type(dlt).has_value());
  for (const int dlt : {9, 105, 127, 147, 192, 249, -1}) CHECK_FALSE(pcap::link_type(dlt).has_value());
}
