// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stage_timer.hpp"

#include <algorithm>
#include <numeric>

#include "percentile.hpp"

namespace pago::perf {

StageTimer::StageTimer(benchmark::State& state, const Drive& drive)
    : state_(state), copy_(drive.sweep_bytes) {
  const auto sweeps = static_cast<std::size_t>(state.max_iterations);
  stage_ms_.reserve(sweeps);
  copy_ms_.reserve(sweeps);
}

void StageTimer::record(std::int64_t cpu_ns) {
  state_.SetIterationTime(static_cast<double>(cpu_ns) * 1e-9);
  stage_ms_.push_back(static_cast<double>(cpu_ns) * 1e-6);
  copy_ms_.push_back(copy_.run_ms());
}

void StageTimer::report() const {
  const double copy_ms = percentile(copy_ms_, 50.0);
  state_.counters["p50_ms"] = percentile(stage_ms_, 50.0);
  state_.counters["p99_ms"] = percentile(stage_ms_, 99.0);
  state_.counters["max_ms"] = percentile(stage_ms_, 100.0);
  state_.counters["copy_ms"] = copy_ms;
  state_.counters["per_copy"] = percentile(stage_ms_, 50.0) / copy_ms;
}

void StageTimer::report(std::size_t packets) const {
  report();
  const double sum_s = std::accumulate(stage_ms_.begin(), stage_ms_.end(), 0.0) * 1e-3;
  state_.counters["packets_s"] = static_cast<double>(packets) / sum_s;
}

}  // namespace pago::perf
