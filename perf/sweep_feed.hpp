// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "drive.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"

namespace pago::perf {

/// The drive's whole sweeps, once through, each made from its packets when it is asked for: so every stage
/// finds its input as it does in the pipeline, fresh from the stage before it.
class SweepFeed final : private SweepExchange {
 public:
  explicit SweepFeed(const Drive& drive);

  /// The next sweep, which is valid until the next call; null at the drive's end. This is the whole work of
  /// the ingest thread.
  Sweep* next() noexcept;

  /// How many packets have been used.
  std::size_t packets_used() const noexcept { return next_datagram_; }
  std::string refusal() const { return ingest_.refusal(); }

 private:
  // Given out, being filled, and the one that the assembler takes at a cut before it hands on.
  static constexpr std::size_t kSweeps = 3;

  Sweep* acquire() noexcept override;
  void hand_on(const SweepPart& part) noexcept override;
  Sweep* give() noexcept;

  const Drive& drive_;
  SweepRing ring_;
  PacketIngest ingest_;
  std::size_t next_datagram_ = 0;
  bool is_finished_ = false;
  Sweep* ready_ = nullptr;  // handed on, not given out yet
  Sweep* given_ = nullptr;
};

}  // namespace pago::perf
