// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "copy_kernel.hpp"
#include "drive.hpp"
#include "pago/platform/clock.hpp"

namespace pago::perf {

/// Takes the time of one stage on each sweep of a benchmark: thread CPU time, so that being interrupted does
/// not count (what an interruption leaves behind in the caches does). After each sweep the copy kernel runs.
class StageTimer {
 public:
  StageTimer(benchmark::State& state, const Drive& drive);

  /// Once per iteration of the benchmark.
  template <typename Work>
  void time(Work&& work) {
    const std::int64_t before_ns = platform::thread_cpu_ns();
    work();
    record(platform::thread_cpu_ns() - before_ns);
  }

  /// At the end: counters p50_ms, p99_ms, max_ms, copy_ms, per_copy.
  void report() const;
  /// And packets_s, by the sum of all times.
  void report(std::size_t packets) const;

 private:
  void record(std::int64_t cpu_ns);

  benchmark::State& state_;
  CopyKernel copy_;
  std::vector<double> stage_ms_, copy_ms_;
};

/// Makes `body(state)` a row of the table: an iteration per sweep, three passes over the drive (so a p99 is
/// of 459 sweeps and not the worst of 153 or nearly so), and all of that three times.
template <typename Body>
void register_per_sweep(const char* name, const Drive& drive, Body body) {
  constexpr int kPasses = 3, kRepetitions = 3;
  benchmark::RegisterBenchmark(name, body)
      ->Iterations(kPasses * static_cast<benchmark::IterationCount>(drive.num_sweeps))
      ->Repetitions(kRepetitions)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace pago::perf
