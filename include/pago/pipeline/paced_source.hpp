// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "pago/core/sources.hpp"

namespace pago {

/// Makes a recorded source behave like a live one: its datagrams come when they are due, `speed` times as
/// fast as they were recorded, and arrive now. What nobody fetches in time is late, as in a socket's buffer,
/// but never lost. Holds a reference: the recorded source must outlive it. [ingest thread] receive() sleeps
/// for `interval_ns` if nothing is due, so that what falls due in between comes together; real-time safe if
/// the recorded source is.
class PacedSource final : public PacketSource {
 public:
  explicit PacedSource(PacketSource& recorded,
                       double speed = 1.0,
                       std::int64_t interval_ns = 2'000'000) noexcept;

  std::span<const Datagram> receive() noexcept override;
  bool all_done() const noexcept override;
  SourceCounters counters() const noexcept override;
  Progress progress() const noexcept override { return recorded_.progress(); }
  std::string complaint() const override { return recorded_.complaint(); }
  bool has_labels() const noexcept override { return recorded_.has_labels(); }
  void label(Sweep& sweep) const noexcept override { recorded_.label(sweep); }

  /// [after the end] How late the datagrams were handed out, at most.
  std::int64_t worst_lateness_ns() const noexcept { return worst_lateness_ns_; }

 private:
  std::int64_t due_ns(const Datagram& datagram) const noexcept;
  bool fetch() noexcept;

  PacketSource& recorded_;
  double speed_;
  std::int64_t interval_ns_;
  std::span<const Datagram> waiting_;
  bool has_started_ = false;
  std::int64_t first_arrival_ns_ = 0, start_ns_ = 0;  // recorded; monotonic
  std::int64_t to_realtime_ns_ = 0;                   // from the monotonic clock, at the start
  std::int64_t worst_lateness_ns_ = 0;
  std::array<Datagram, 64> batch_{};
};

}  // namespace pago
