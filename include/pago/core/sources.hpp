// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "pago/core/sweep.hpp"

namespace pago {

/// One UDP payload and how it came. The bytes stay valid until the source's next receive().
struct Datagram {
  std::span<const std::uint8_t> payload;
  std::int64_t arrival_ns = 0;    ///< host clock, ns since the Unix epoch (capture time in a replay)
  std::uint32_t source_ipv4 = 0;  ///< host byte order; 0 where the carrier has none (IPv6, raw)
  std::uint16_t source_port = 0, destination_port = 0;
};

/// What a source met before a datagram could be handed on. received = delivered + filtered + bad.
struct SourceCounters {
  std::uint64_t received = 0;  ///< link-level records; the fragments of one datagram count once
  std::uint64_t delivered = 0;
  std::uint64_t filtered = 0;       ///< not UDP, another port, another sender
  std::uint64_t truncated = 0;      ///< recorded or received shorter than it was sent
  std::uint64_t fragment_lost = 0;  ///< a fragment whose siblings never came
  std::uint64_t malformed = 0;      ///< link, IP or UDP header that contradicts itself
  /// Not among the received: the kernel had no room for them (its own count, SO_RXQ_OVFL). They show again as
  /// lost firings.
  std::uint64_t kernel_dropped = 0;

  std::uint64_t bad() const noexcept { return truncated + fragment_lost + malformed; }
  bool balanced() const noexcept { return received == delivered + filtered + bad(); }
};

/// How far a source with an end has come, in whatever unit it counts. total = 0: it has no end.
struct Progress {
  double done = 0.0, total = 0.0;
};

/// Where packets come from: a socket, a capture, the simulator. Created open and usable, or not at all
/// (Error). [ingest thread] receive() and all_done(); [any thread] nothing.
class PacketSource {
 public:
  virtual ~PacketSource() = default;

  /// Up to 64 datagrams in order of arrival; empty when there are none just now, or no more at all.
  virtual std::span<const Datagram> receive() noexcept = 0;

  /// True once the source has ended and everything was handed out.
  virtual bool all_done() const noexcept = 0;

  virtual SourceCounters counters() const noexcept = 0;
  virtual Progress progress() const noexcept = 0;

  /// What went wrong in the middle of the source, e.g. "capture ends inside a record at byte 125,424"; empty
  /// if nothing.
  virtual std::string complaint() const = 0;

  /// Whether label() does anything: a simulator knows what its packets are of. [any thread]
  virtual bool has_labels() const noexcept { return false; }
  /// Labels a complete sweep that was made of this source's packets, and sets kLabelled. [ingest thread]
  virtual void label(Sweep&) const noexcept {}
};

/// Where whole sweeps come from (KITTI folders). Same life as PacketSource.
class SweepSource {
 public:
  virtual ~SweepSource() = default;

  /// Fills an empty sweep: header, returns, range image. False when there are no more, or on a fault (see
  /// complaint()).
  virtual bool fill(Sweep& sweep) noexcept = 0;

  virtual Progress progress() const noexcept = 0;

  /// Empty, or why the source ended before its end; then the run has failed.
  virtual std::string complaint() const = 0;
};

}  // namespace pago
