// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_feed.hpp"

#include <utility>

#include "pago/platform/clock.hpp"

namespace pago::perf {

SweepFeed::SweepFeed(const Drive& drive)
    : drive_(drive),
      ring_(kSweeps, max_returns_of(drive.config.assembly, /*can_be_dual=*/true)),
      ingest_(drive.config.assembly, drive.config.hdl64, drive.calibration, *this) {}

Sweep* SweepFeed::next() noexcept {
  if (given_ != nullptr) ring_.release(std::exchange(given_, nullptr));
  while (next_datagram_ < drive_.datagrams.size()) {
    ingest_.push(drive_.datagrams[next_datagram_++]);
    if (Sweep* sweep = give()) return sweep;
  }
  if (!std::exchange(is_finished_, true)) ingest_.finish();
  return give();
}

/// A part of a rotation at either end of the drive is put back.
Sweep* SweepFeed::give() noexcept {
  Sweep* sweep = std::exchange(ready_, nullptr);
  if (sweep == nullptr || sweep->header.is_posed()) return given_ = sweep;
  ring_.release(sweep);
  return nullptr;
}

Sweep* SweepFeed::acquire() noexcept {
  return ring_.try_acquire();
}

void SweepFeed::hand_on(const SweepPart& part) noexcept {
  if (!part.last) return;
  part.sweep->header.closed_ns = part.sweep->header.complete_ns = platform::monotonic_ns();
  ready_ = part.sweep;
}

}  // namespace pago::perf
