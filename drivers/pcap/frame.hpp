// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace pago::pcap {

using Bytes = std::span<const std::uint8_t>;

/// What a captured record begins with.
enum class LinkType : std::uint8_t {
  kEthernet,
  kLinuxCooked,   ///< tcpdump -i any, v1
  kLinuxCooked2,  ///< v2
  kRawIp,         ///< the IP header, version by its first nibble
  kLoopback       ///< BSD: a protocol family in the capturing host's byte order (NULL) or big-endian (LOOP)
};

/// From libpcap's DLT number; nothing for layers that are not read.
std::optional<LinkType> link_type(int dlt) noexcept;

/// Names one fragmented datagram (RFC 791, RFC 8200 4.5); IPv4 addresses fill the first four bytes.
struct FragmentKey {
  std::array<std::uint8_t, 16> source{}, destination{};
  std::uint32_t id = 0;
  std::uint8_t version = 0;
  bool operator==(const FragmentKey&) const = default;
};

/// A record taken apart.
struct Frame {
  enum class Kind : std::uint8_t {
    kUdp,       ///< `payload` is a whole UDP payload
    kFragment,  ///< `payload` is (the captured part of) a piece of a UDP datagram, header included
    kOther,     ///< not UDP over IP
    kShort,     ///< ends before its headers say; ports and address are set if they were reached, else 0
    kMalformed  ///< headers contradict themselves
  };
  Kind kind = Kind::kOther;
  Bytes payload;
  std::uint32_t source_ipv4 = 0;  ///< host byte order; 0 for IPv6
  std::uint16_t source_port = 0, destination_port = 0;

  FragmentKey key;                    ///< the rest for fragments, UDP or not
  std::uint32_t fragment_offset = 0;  ///< in bytes, a multiple of 8
  std::uint32_t fragment_length = 0;  ///< as sent; the payload is shorter if the capture cut it
  bool more_fragments = false;
};

/// Pure; any bytes are safe. The payload points into `record`.
Frame parse_frame(LinkType link, Bytes record) noexcept;

/// Reads the UDP header of `datagram`, which is what was captured of `length` bytes, into `frame`: sets kind,
/// ports and payload.
void parse_udp(Bytes datagram, std::size_t length, Frame& frame) noexcept;

}  // namespace pago::pcap
