// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pago/core/sweep.hpp"

namespace pago {

/// The sweeps that exist, handed out and taken back in order like the slots of a ring buffer. All memory is
/// allocated and touched when the ring is made. Both calls belong to one thread (the ingest thread, which
/// gets freed sweeps back through a queue).
class SweepRing {
 public:
  /// [set-up] Allocates `size` (at least 1) sweeps of `max_returns` returns.
  SweepRing(std::size_t size, std::uint32_t max_returns);

  /// [ingest thread] The next sweep, empty but for the stale columns of its range image (Sweep::recycle);
  /// null while all are out.
  Sweep* try_acquire() noexcept;

  /// [ingest thread] Takes back the sweep that has been out longest; it must be that one.
  void release(const Sweep* sweep) noexcept;

  std::size_t size() const noexcept { return sweeps_.size(); }
  /// Sweeps that are out now, and that ever were.
  std::uint64_t in_flight() const noexcept { return acquired_ - released_; }
  std::uint64_t acquired() const noexcept { return acquired_; }

 private:
  std::vector<Sweep> sweeps_;
  std::uint64_t acquired_ = 0, released_ = 0;
};

}  // namespace pago
