// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/packet_filter.hpp"

#include <arpa/inet.h>

#include <array>

#include "pago/core/error.hpp"

namespace pago {

PacketFilter PacketFilter::of(const PacketFilterConfig& config) {
  PacketFilter filter;
  filter.port = checked_port(config.port, "packets.port");
  if (!config.source_address.empty()) {
    filter.address = parse_ipv4(config.source_address, "packets.source_address",
                                "write it as 192.168.3.43, or leave it empty to take every sender");
  }
  return filter;
}

std::uint32_t parse_ipv4(const std::string& text, const std::string& where, const std::string& hint) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1 || address.s_addr == 0)
    throw Error(where, "'" + text + "' is not an IPv4 address", hint);
  return ntohl(address.s_addr);
}

std::string ipv4_text(std::uint32_t address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const in_addr network{.s_addr = htonl(address)};
  inet_ntop(AF_INET, &network, text.data(), text.size());
  return text.data();
}

std::uint16_t checked_port(int port, const std::string& where) {
  if (port < 0 || port > 65535)
    throw Error(where, std::to_string(port) + " is no UDP port",
                "0 takes every port, the sensor's default is 2368");
  return static_cast<std::uint16_t>(port);
}

}  // namespace pago
