// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/jitter.hpp"

#include "pago/platform/clock.hpp"

namespace pago::platform {

JitterMeter::JitterMeter(ThreadPlan plan, std::int64_t period_ns)
    : thread_(std::move(plan), [this, period_ns] { run(period_ns); }) {}

JitterMeter::~JitterMeter() {
  stop();
}

const LatencyHistogram& JitterMeter::stop() {
  is_over_.store(true, std::memory_order_relaxed);  // the join publishes the rest
  thread_.join();
  return *lateness_;
}

void JitterMeter::run(std::int64_t period_ns) noexcept {
  std::int64_t due_ns = monotonic_ns();
  while (!is_over_.load(std::memory_order_relaxed)) {
    due_ns += period_ns;
    sleep_until_ns(due_ns);
    const std::int64_t now_ns = monotonic_ns();
    lateness_->record(now_ns - due_ns);
    while (due_ns + period_ns < now_ns) due_ns += period_ns;
  }
}

}  // namespace pago::platform
