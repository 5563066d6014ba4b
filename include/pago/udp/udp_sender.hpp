// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "pago/core/sources.hpp"
#include "pago/udp/udp_source.hpp"

namespace pago {

/// Sends datagrams as a sensor would. [one thread] not real-time; blocks while the kernel has no room.
class UdpSender {
 public:
  /// [set-up] To ADDRESS:PORT (127.0.0.1 where the address is empty); broadcast addresses are allowed. Throws
  /// Error.
  explicit UdpSender(const UdpEndpoint& destination);
  ~UdpSender();

  /// Sends the payloads, up to 64, in order, in one system call or few.
  void send(std::span<const Datagram> datagrams) noexcept;

  std::uint64_t sent() const noexcept;
  std::uint64_t unsent() const noexcept;  ///< refused by the kernel, e.g. without a route

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
