// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/pcap/frame.hpp"
#include "support/pcap_writer.hpp"

namespace pago::test {

/// Bytes that differ from their neighbours, so that a shift shows.
inline Octets counting_payload(std::size_t size, std::uint8_t start = 0) {
  Octets out(size);
  for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(start + i * 7 + i / 256);
  return out;
}

inline Octets joined(OctetView a, OctetView b) {
  Octets out(a.begin(), a.end());
  append(out, b);
  return out;
}

inline Octets vlan(OctetView body, std::uint16_t ethertype = 0x0800) {
  Octets out;
  put_be16(out, 42);
  put_be16(out, ethertype);
  append(out, body);
  return out;
}

/// IPv6 header for `body`, whose first header is `next`.
inline Octets ipv6(OctetView body, std::uint8_t next = 17) {
  Octets out{0x60, 0, 0, 0};
  put_be16(out, body.size());
  out.insert(out.end(), {next, 64});
  for (std::uint8_t i = 0; i < 32; ++i) out.push_back(static_cast<std::uint8_t>(0x20 + i));
  append(out, body);
  return out;
}

/// An IPv6 options, routing or destination header of 8 * (more + 1) bytes before `body`.
inline Octets extension(OctetView body, std::uint8_t next, std::uint8_t more = 0) {
  Octets out(8U * (more + 1U), 0);
  out[0] = next;
  out[1] = more;
  append(out, body);
  return out;
}

inline Octets ipv6_fragment(OctetView body, const FragmentPlace& place, std::uint8_t next = 17) {
  Octets out{next, 0};
  put_be16(out, place.offset | (place.more ? 1U : 0U));
  put_be32(out, place.id);
  append(out, body);
  return out;
}

/// One way of carrying a datagram that must be read.
struct Carrier {
  std::string name;
  pcap::LinkType link;
  Octets frame;
};

/// The same UDP datagram in every carrier.
inline std::vector<Carrier> carriers(OctetView payload) {
  using enum pcap::LinkType;
  const Octets datagram = udp(payload);
  const Octets v4 = ipv4(datagram), v6 = ipv6(datagram);
  const Octets sll(14, 0x01), sll2_rest(18, 0x02);
  const Octets is_v4{0x08, 0x00}, is_v6{0x86, 0xDD}, is_tag{0x81, 0x00};
  return {
      {"Ethernet, IPv4", kEthernet, ethernet(v4)},
      {"Ethernet, IPv6", kEthernet, ethernet(v6, 0x86DD)},
      {"Ethernet, padded", kEthernet, joined(ethernet(v4), Octets(6, 0))},
      {"802.1Q", kEthernet, ethernet(vlan(v4), 0x8100)},
      {"802.1ad", kEthernet, ethernet(vlan(vlan(v4), 0x8100), 0x88A8)},
      {"three old tags", kEthernet, ethernet(vlan(vlan(vlan(v4), 0x8100), 0x9200), 0x9100)},
      {"tagged IPv6", kEthernet, ethernet(vlan(v6, 0x86DD), 0x8100)},
      {"cooked", kLinuxCooked, joined(joined(sll, is_v4), v4)},
      {"cooked, tagged", kLinuxCooked, joined(joined(sll, is_tag), vlan(v4))},
      {"cooked v2", kLinuxCooked2, joined(joined(is_v4, sll2_rest), v4)},
      {"cooked v2, tagged IPv6", kLinuxCooked2, joined(joined(is_tag, sll2_rest), vlan(v6, 0x86DD))},
      {"raw IPv4", kRawIp, v4},
      {"raw IPv6", kRawIp, v6},
      {"loopback, little-endian", kLoopback, joined(Octets{2, 0, 0, 0}, v4)},
      {"loopback, big-endian", kLoopback, joined(Octets{0, 0, 0, 2}, v4)},
      {"loopback, FreeBSD IPv6", kLoopback, joined(Octets{28, 0, 0, 0}, v6)},
      {"IPv4 options", kRawIp, ipv4(datagram, {}, {}, Octets(8, 1))},
      {"longest IPv4 header", kRawIp, ipv4(datagram, {}, {}, Octets(40, 1))},
      {"IPv6 hop-by-hop", kRawIp, ipv6(extension(datagram, 17), 0)},
      {"IPv6 routing, options", kRawIp, ipv6(extension(extension(datagram, 17, 2), 60), 43)},
      {"IPv6 authentication", kRawIp,
       ipv6(joined(Octets{17, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1}, datagram), 51)},
      {"IPv6 atomic fragment", kRawIp, ipv6(ipv6_fragment(datagram, {.id = 9}), 44)},
  };
}

}  // namespace pago::test
