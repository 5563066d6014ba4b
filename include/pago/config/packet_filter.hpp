// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/config/drivers.hpp"

namespace pago {

/// Which datagrams are the sensor's, in the form in which a driver asks: numbers in host byte order.
struct PacketFilter {
  std::uint16_t port = 0;     ///< of the destination; 0: any
  std::uint32_t address = 0;  ///< of the sender, IPv4; 0: any

  /// [set-up] Throws Error for a setting that is no port or no IPv4 address.
  static PacketFilter of(const PacketFilterConfig& config);

  /// [any thread] Real-time safe.
  bool takes_sender(std::uint32_t source_ipv4) const noexcept {
    return address == 0 || source_ipv4 == address;
  }
  bool takes(std::uint32_t source_ipv4, std::uint16_t destination_port) const noexcept {
    return takes_sender(source_ipv4) && (port == 0 || destination_port == port);
  }
};

/// [set-up] An IPv4 address in host byte order; throws Error at `where` if `text` is none, or 0.0.0.0.
std::uint32_t parse_ipv4(const std::string& text, const std::string& where, const std::string& hint);
/// "192.168.3.43"
std::string ipv4_text(std::uint32_t address);

/// [set-up] Throws Error at `where` unless 0 <= port <= 65535.
std::uint16_t checked_port(int port, const std::string& where);

}  // namespace pago
