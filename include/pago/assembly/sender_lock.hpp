// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "pago/core/sources.hpp"

namespace pago {

/// Keeps to one of several senders on a port: the one that was first. Another one is accepted when that has
/// been silent for five seconds by the host's clock (the sensor was replaced), or was banned. Carriers
/// without IPv4 addresses have one sender. [ingest thread] real-time safe.
class SenderLock {
 public:
  enum class Verdict : std::uint8_t {
    kOurs,
    kReplaced,  ///< from now on this one is
    kForeign
  };

  Verdict judge(const Datagram& datagram) noexcept {
    const bool is_same = datagram.source_ipv4 == ipv4_ && datagram.source_port == port_;
    const bool is_early = is_locked_ && !is_same && datagram.arrival_ns - last_arrival_ns_ < kPatience_ns;
    if (is_early || is_banned(datagram)) {
      other_ipv4_ = datagram.source_ipv4;
      return Verdict::kForeign;
    }
    const Verdict verdict = is_locked_ && !is_same ? Verdict::kReplaced : Verdict::kOurs;
    is_locked_ = true;
    ipv4_ = datagram.source_ipv4;
    port_ = datagram.source_port;
    last_arrival_ns_ = datagram.arrival_ns;
    return verdict;
  }

  /// The present sender is not what is looked for; the next other one will do.
  void ban() noexcept {
    banned_[num_banned_++ % banned_.size()] = {ipv4_, port_};
    is_locked_ = false;
  }

  std::uint32_t ipv4() const noexcept { return ipv4_; }  ///< host byte order; 0: unknown
  std::uint16_t port() const noexcept { return port_; }
  std::uint32_t other_ipv4() const noexcept { return other_ipv4_; }  ///< of the last foreign one

 private:
  static constexpr std::int64_t kPatience_ns = 5'000'000'000;

  struct Sender {
    std::uint32_t ipv4 = 0;
    std::uint16_t port = 0;
  };
  bool is_banned(const Datagram& datagram) const noexcept {
    const std::size_t n = std::min(num_banned_, banned_.size());
    return std::any_of(banned_.begin(), banned_.begin() + n, [&](const Sender& banned) {
      return datagram.source_ipv4 == banned.ipv4 && datagram.source_port == banned.port;
    });
  }

  std::array<Sender, 8> banned_{};  // a ring
  std::size_t num_banned_ = 0;
  bool is_locked_ = false;
  std::uint32_t ipv4_ = 0, other_ipv4_ = 0;
  std::uint16_t port_ = 0;
  std::int64_t last_arrival_ns_ = 0;
};

}  // namespace pago
