// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "pago/config/drivers.hpp"
#include "pago/core/sources.hpp"

namespace pago {

/// Where a live sensor's datagrams arrive.
struct UdpEndpoint {
  std::string address;  ///< IPv4 of one of this host's interfaces; empty: all of them
  int port = 2368;
};

/// [set-up] Reads "udp://[ADDRESS]:PORT"; either part may be missing (port: 2368). Throws Error.
UdpEndpoint parse_udp_endpoint(const std::string& text);
std::string to_string(const UdpEndpoint& endpoint);

/// Receives a live sensor's datagrams. The socket is emptied every few milliseconds (`udp.drain_interval_ms`)
/// in batches of 64, instead of waking for each packet, which costs ten times as much CPU (measured: 33
/// against 4 to 6 us a packet). Arrival is the kernel's own stamp (SO_TIMESTAMPNS), so the interval adds
/// latency but no error. What the kernel had to drop is counted (SO_RXQ_OVFL).
///
/// The source never ends by itself: sensors are switched off and on again. [set-up] constructor; [ingest
/// thread] the rest; receive() sleeps until the next drain (two system calls: clock_nanosleep, recvmmsg),
/// never allocates.
class UdpSource final : public PacketSource {
 public:
  static constexpr std::size_t kBatch = 64;
  /// Longest payload handed on; longer ones count as truncated. An HDL-64E sends 1,206 bytes.
  static constexpr std::size_t kMaxPayloadBytes = 2048;

  /// Throws Error if the port is taken, the address is not this host's, or the filter is not valid.
  UdpSource(const UdpEndpoint& endpoint, const PacketFilterConfig& filter = {}, const UdpConfig& config = {});
  ~UdpSource() override;

  std::span<const Datagram> receive() noexcept override;
  /// True only when the socket has failed for good; see complaint().
  bool all_done() const noexcept override;
  SourceCounters counters() const noexcept override;
  Progress progress() const noexcept override { return {}; }
  std::string complaint() const override;

  /// The port that the socket got: the one asked for, or one of the kernel's choice for 0.
  int port() const noexcept;
  /// What the kernel granted, in its own measure: about 2.3 kB a datagram.
  int receive_buffer_bytes() const noexcept;
  /// Whole sentences for the user, e.g. that the kernel granted a smaller buffer and how to get it.
  std::vector<std::string> warnings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
