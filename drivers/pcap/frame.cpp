// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frame.hpp"

#include <algorithm>

namespace pago::pcap {
namespace {

constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeaderBytes = 8;

std::uint16_t be16(Bytes b, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(b[at] << 8 | b[at + 1]);
}
std::uint32_t be32(Bytes b, std::size_t at) noexcept {
  return static_cast<std::uint32_t>(be16(b, at)) << 16 | be16(b, at + 2);
}

void set_fragment(Frame& frame, Bytes piece, std::size_t length) noexcept {
  // Only the last piece may end off an 8-byte boundary, and nothing may pass 65,535 bytes (RFC 791).
  const bool fits =
      length > 0 && (!frame.more_fragments || length % 8 == 0) && frame.fragment_offset + length <= 65535;
  frame.kind = fits ? Frame::Kind::kFragment : Frame::Kind::kMalformed;
  frame.fragment_length = static_cast<std::uint32_t>(length);
  frame.payload = piece;
}

void parse_ipv4(Bytes b, Frame& frame) noexcept {
  if (b.size() < 20) {
    frame.kind = Frame::Kind::kShort;
    return;
  }
  const std::size_t header = (b[0] & 0x0FU) * 4;
  const std::size_t total = be16(b, 2);
  if (b[0] >> 4 != 4 || header < 20 || total < header) {
    frame.kind = Frame::Kind::kMalformed;
    return;
  }
  frame.source_ipv4 = be32(b, 12);
  frame.more_fragments = (b[6] & 0x20) != 0;
  frame.fragment_offset = (be16(b, 6) & 0x1FFFU) * 8;
  if (b[9] != kProtocolUdp) return;
  if (b.size() < header) {
    frame.kind = Frame::Kind::kShort;
    return;
  }
  const std::size_t length = total - header;
  const Bytes body = b.subspan(header, std::min(length, b.size() - header));  // without Ethernet's padding
  if (!frame.more_fragments && frame.fragment_offset == 0) return parse_udp(body, length, frame);
  frame.key.version = 4;
  frame.key.id = be16(b, 4);
  std::copy_n(b.begin() + 12, 4, frame.key.source.begin());
  std::copy_n(b.begin() + 16, 4, frame.key.destination.begin());
  set_fragment(frame, body, length);
}

/// Length of an IPv6 extension header of type `type` at the start of `b` (two bytes at least); 0: no such.
std::size_t extension_bytes(std::uint8_t type, Bytes b) noexcept {
  switch (type) {
    case 0:   // hop-by-hop options
    case 43:  // routing
    case 60:  // destination options
      return (b[1] + 1U) * 8;
    case 51:  // authentication (RFC 4302)
      return (b[1] + 2U) * 4;
    case 44:  // fragment
      return 8;
    default:
      return 0;
  }
}

/// Everything after the fixed header: `b` is what was captured of `length` bytes, beginning with `next`.
void parse_ipv6_body(Bytes b, std::size_t length, std::uint8_t next, Frame& frame) noexcept {
  while (next != kProtocolUdp) {
    if (b.size() < 2) {
      frame.kind = length < 2 ? Frame::Kind::kMalformed : Frame::Kind::kShort;
      return;
    }
    const std::size_t bytes = extension_bytes(next, b);
    if (bytes == 0) return;
    if (b.size() < bytes) {
      frame.kind = length < bytes ? Frame::Kind::kMalformed : Frame::Kind::kShort;
      return;
    }
    const bool is_fragment_header = next == 44;
    next = b[0];
    if (is_fragment_header) {
      frame.fragment_offset = be16(b, 2) & 0xFFF8U;
      frame.more_fragments = (b[3] & 1) != 0;
      frame.key.id = be32(b, 4);
    }
    b = b.subspan(bytes);
    length -= bytes;
    // A piece other than the first does not begin with a header, whatever `next` says.
    if (frame.fragment_offset != 0 || frame.more_fragments) break;
  }
  if (next != kProtocolUdp) return;
  if (!frame.more_fragments && frame.fragment_offset == 0) return parse_udp(b, length, frame);
  set_fragment(frame, b, length);
}

void parse_ipv6(Bytes b, Frame& frame) noexcept {
  if (b.size() < 40) {
    frame.kind = Frame::Kind::kShort;
    return;
  }
  if (b[0] >> 4 != 6) {
    frame.kind = Frame::Kind::kMalformed;
    return;
  }
  frame.key.version = 6;
  std::copy_n(b.begin() + 8, 16, frame.key.source.begin());
  std::copy_n(b.begin() + 24, 16, frame.key.destination.begin());
  const std::size_t length = be16(b, 4);
  parse_ipv6_body(b.subspan(40, std::min(length, b.size() - 40)), length, b[6], frame);
}

void parse_ip(Bytes b, Frame& frame) noexcept {
  if (b.empty())
    frame.kind = Frame::Kind::kShort;
  else if (b[0] >> 4 == 4)
    parse_ipv4(b, frame);
  else if (b[0] >> 4 == 6)
    parse_ipv6(b, frame);
  else
    frame.kind = Frame::Kind::kMalformed;
}

bool is_vlan_tag(std::uint16_t ethertype) noexcept {
  // 802.1Q, 802.1ad, and the types of QinQ before it was standardised; they may stack.
  return ethertype == 0x8100 || ethertype == 0x88A8 || ethertype == 0x9100 || ethertype == 0x9200;
}

/// `header` bytes of link layer, whose protocol field is at `at`.
void parse_ethertype(Bytes b, std::size_t at, std::size_t header, Frame& frame) noexcept {
  frame.kind = Frame::Kind::kShort;
  if (b.size() < header) return;
  std::uint16_t type = be16(b, at);
  Bytes body = b.subspan(header);
  while (is_vlan_tag(type)) {
    if (body.size() < 4) return;
    type = be16(body, 2);
    body = body.subspan(4);
  }
  frame.kind = Frame::Kind::kOther;
  if (type == 0x0800) parse_ipv4(body, frame);
  if (type == 0x86DD) parse_ipv6(body, frame);
}

void parse_loopback(Bytes b, Frame& frame) noexcept {
  if (b.size() < 4) {
    frame.kind = Frame::Kind::kShort;
    return;
  }
  // The byte order is the capturing host's, which the file does not tell for certain: all families are < 256.
  const std::uint32_t value = be32(b, 0);
  const std::uint32_t family = value < 256 ? value : (value & 0x00FFFFFFU) == 0 ? value >> 24 : 0;
  switch (family) {
    case 2:  // AF_INET everywhere
      return parse_ipv4(b.subspan(4), frame);
    case 10:  // AF_INET6 of Linux, NetBSD and OpenBSD, FreeBSD, macOS
    case 24:
    case 28:
    case 30:
      return parse_ipv6(b.subspan(4), frame);
    default:
      return;
  }
}

}  // namespace

std::optional<LinkType> link_type(int dlt) noexcept {
  switch (dlt) {  // numbers, not pcap.h's names: DLT_RAW differs between systems
    case 1:
      return LinkType::kEthernet;
    case 113:
      return LinkType::kLinuxCooked;
    case 276:
      return LinkType::kLinuxCooked2;
    case 12:
    case 14:
    case 101:
    case 228:
    case 229:
      return LinkType::kRawIp;
    case 0:
    case 108:
      return LinkType::kLoopback;
    default:
      return std::nullopt;
  }
}

void parse_udp(Bytes datagram, std::size_t length, Frame& frame) noexcept {
  if (datagram.size() >= 4) {
    frame.source_port = be16(datagram, 0);
    frame.destination_port = be16(datagram, 2);
  }
  if (length < kUdpHeaderBytes) {
    frame.kind = Frame::Kind::kMalformed;
    return;
  }
  if (datagram.size() < kUdpHeaderBytes) {
    frame.kind = Frame::Kind::kShort;
    return;
  }
  const std::size_t udp_length = be16(datagram, 4);
  if (udp_length < kUdpHeaderBytes || udp_length > length) {
    frame.kind = Frame::Kind::kMalformed;
  } else if (udp_length > datagram.size()) {
    frame.kind = Frame::Kind::kShort;
  } else {
    frame.kind = Frame::Kind::kUdp;
    frame.payload = datagram.subspan(kUdpHeaderBytes, udp_length - kUdpHeaderBytes);
  }
}

Frame parse_frame(LinkType link, Bytes record) noexcept {
  Frame frame;
  switch (link) {
    case LinkType::kEthernet:
      parse_ethertype(record, 12, 14, frame);
      break;
    case LinkType::kLinuxCooked:
      parse_ethertype(record, 14, 16, frame);
      break;
    case LinkType::kLinuxCooked2:
      parse_ethertype(record, 0, 20, frame);
      break;
    case LinkType::kRawIp:
      parse_ip(record, frame);
      break;
    case LinkType::kLoopback:
      parse_loopback(record, frame);
      break;
  }
  return frame;
}

}  // namespace pago::pcap
