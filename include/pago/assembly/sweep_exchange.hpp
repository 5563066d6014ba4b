// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/stage.hpp"

namespace pago {

/// Where the assembler gets empty sweeps and hands on what it fills; the pipeline decides what lies behind.
/// [ingest thread] both calls; once per sweep or part, never per packet.
class SweepExchange {
 public:
  virtual ~SweepExchange() = default;

  /// A sweep, empty but for the stale columns of its range image (Sweep::recycle), or null when none is free:
  /// then the assembler gives up a rotation and counts it. A replay waits in here until one comes back, and
  /// never returns null. The assembler holds at most one sweep when it calls.
  virtual Sweep* acquire() noexcept = 0;

  /// A part of a sweep that was acquired here, at most `sectors` for each sweep; the one with `last` set
  /// gives the sweep away. Whoever implements this stamps `header.closed_ns` of the last part, since the
  /// assembler knows no clock.
  virtual void hand_on(const SweepPart& part) noexcept = 0;
};

}  // namespace pago
