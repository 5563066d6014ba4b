// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/assembly/sweep_exchange.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/core/sources.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/platform/clock.hpp"
#include "runner.hpp"

namespace pago {

/// The ingest thread's side of the sweep ring. When every sweep is in use, a replay waits until the last
/// stage has freed one, so that nothing is dropped; live, there is none, and the assembler gives up a
/// rotation.
class RingExchange final : public SweepExchange {
 public:
  RingExchange(
      SweepRing& ring, platform::Channel<Sweep*>& freed, Link<SweepPart>& parts, Pace pace, Recorded unmet)
      : ring_(ring), freed_(freed), parts_(parts), is_live_(pace == Pace::kLive), unmet_(unmet) {}

  Sweep* acquire() noexcept override {
    ++requests_;
    if (unmet_.has(requests_)) return nullptr;
    for (Sweep* sweep = nullptr; freed_.try_pop(sweep);) ring_.release(sweep);
    Sweep* sweep = ring_.try_acquire();
    while (sweep == nullptr && !is_live_) {
      ring_.release(pop(freed_));
      sweep = ring_.try_acquire();
    }
    if (sweep == nullptr) return nullptr;
    sweep->header.request = requests_;
    sweep->time_of(StageId::kIngest).start_ns = platform::monotonic_ns();
    return sweep;
  }

  /// Sweeps are labelled before they are handed on in full, if the source can.
  void label_by(const PacketSource& source) noexcept { labeller_ = source.has_labels() ? &source : nullptr; }

  void hand_on(const SweepPart& part) noexcept override {
    if (part.last) {
      if (labeller_ != nullptr) labeller_->label(*part.sweep);
      stamp(*part.sweep);
      parts_.backlog.arrived();
    }
    push(parts_.channel, part);
  }

  std::uint64_t requests() const noexcept { return requests_; }

  void end() noexcept { push(parts_.channel, SweepPart{}); }

 private:
  void stamp(Sweep& sweep) noexcept {
    SweepHeader& header = sweep.header;
    StageTime& time = sweep.time_of(StageId::kIngest);
    header.closed_ns = header.complete_ns = time.end_ns = platform::monotonic_ns();
    if (is_live_) header.complete_ns -= platform::realtime_ns() - header.last_arrival_ns;
    const std::int64_t cpu_ns = platform::thread_cpu_ns();
    time.cpu_ns = cpu_ns - cpu_before_ns_;
    cpu_before_ns_ = cpu_ns;
  }

  SweepRing& ring_;
  platform::Channel<Sweep*>& freed_;
  Link<SweepPart>& parts_;
  bool is_live_;
  Recorded unmet_;
  const PacketSource* labeller_ = nullptr;
  std::uint64_t requests_ = 0;
  std::int64_t cpu_before_ns_ = 0;  // of this thread, when the last sweep was handed on
};

}  // namespace pago
