// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/assembly/sweep_exchange.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/platform/clock.hpp"
#include "runner.hpp"

namespace pago {

/// The ingest thread's side of the sweep ring in a replay: when every sweep is in use, it waits until the
/// last stage has freed one, so that nothing is dropped.
class ReplayExchange final : public SweepExchange {
 public:
  ReplayExchange(SweepRing& ring, platform::Channel<Sweep*>& freed, platform::Channel<SweepPart>& parts)
      : ring_(ring), freed_(freed), parts_(parts) {}

  Sweep* acquire() noexcept override {
    for (Sweep* sweep = nullptr; freed_.try_pop(sweep);) ring_.release(sweep);
    Sweep* sweep = ring_.try_acquire();
    while (sweep == nullptr) {
      ring_.release(pop(freed_));
      sweep = ring_.try_acquire();
    }
    sweep->time_of(StageId::kIngest).start_ns = platform::monotonic_ns();
    return sweep;
  }

  void hand_on(const SweepPart& part) noexcept override {
    if (part.last) {
      part.sweep->header.closed_ns = platform::monotonic_ns();
      StageTime& time = part.sweep->time_of(StageId::kIngest);
      time.end_ns = part.sweep->header.closed_ns;
      const std::int64_t cpu_ns = platform::thread_cpu_ns();
      time.cpu_ns = cpu_ns - cpu_before_ns_;
      cpu_before_ns_ = cpu_ns;
    }
    push(parts_, part);
  }

  void end() noexcept { push(parts_, SweepPart{}); }

 private:
  SweepRing& ring_;
  platform::Channel<Sweep*>& freed_;
  platform::Channel<SweepPart>& parts_;
  std::int64_t cpu_before_ns_ = 0;  // of this thread, when the last sweep was handed on
};

}  // namespace pago
