// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "context.hpp"
#include "pago/core/histogram.hpp"
#include "pago/platform/clock.hpp"
#include "pinned.hpp"
#include "sleep_until.hpp"

// The machine's own jitter: how late a thread wakes that does nothing but sleep until the next millisecond.
// No pipeline on this machine can have a shorter tail.

using namespace pago;

namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

struct Core {
  LatencyHistogram late;
  std::string scheduling;
};

void sleep_and_wake(LatencyHistogram& late, int wake_ups) {
  std::int64_t due_ns = platform::monotonic_ns();
  for (int i = 0; i < wake_ups; ++i) {
    due_ns += kPeriod_ns;
    perf::sleep_until(due_ns);
    const std::int64_t now_ns = platform::monotonic_ns();
    late.record(now_ns - due_ns);
    // Wake-ups that were missed altogether are one late one, not many.
    while (due_ns + kPeriod_ns < now_ns) due_ns += kPeriod_ns;
  }
}

/// All cores at once: that is how the pipeline uses them.
std::vector<Core> measure(int wake_ups, int fifo_priority) {
  std::vector<Core> cores(std::thread::hardware_concurrency());
  std::vector<platform::Thread> threads;
  for (std::size_t i = 0; i < cores.size(); ++i) {
    Core& core = cores[i];
    threads.emplace_back(perf::pinned("jitter", static_cast<int>(i), fifo_priority),
                         [&core, wake_ups] { sleep_and_wake(core.late, wake_ups); });
    core.scheduling = perf::scheduling_of(threads.back());
  }
  for (platform::Thread& thread : threads) thread.join();
  return cores;
}

void print(const std::vector<Core>& cores) {
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-3; };
  for (std::size_t i = 0; i < cores.size(); ++i) {
    const LatencyHistogram& late = cores[i].late;
    std::printf("| %4zu | %-22s | %8.1f | %8.1f | %8.1f | %9.1f | %9.1f |\n", i, cores[i].scheduling.c_str(),
                us(late.percentile(50.0)), us(late.percentile(90.0)), us(late.percentile(99.0)),
                us(late.percentile(99.9)), us(late.max()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 5.0;
  if (argc > 2 || !(seconds > 0.0 && seconds <= 86'400.0)) {
    std::fprintf(stderr, "usage: %s [seconds, 5]\n", argv[0]);
    return 2;
  }
  const int wake_ups = static_cast<int>(seconds * 1e9 / static_cast<double>(kPeriod_ns));
  std::printf("%s\n\nlateness of a timer of 1 ms, %.0f s, all cores at once, us\n\n",
              perf::context_line().c_str(), seconds);
  std::printf("| core | scheduling             |      p50 |      p90 |      p99 |     p99.9 |       max |\n");
  std::printf("|-----:|------------------------|---------:|---------:|---------:|----------:|----------:|\n");
  for (const int fifo_priority : {0, perf::kFifoPriority}) print(measure(wake_ups, fifo_priority));
  std::printf("\nafter the run: %s\n", perf::context_line().c_str());
}
