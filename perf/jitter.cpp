// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "context.hpp"
#include "pago/platform/jitter.hpp"
#include "pinned.hpp"

// The machine's own jitter: how late a thread wakes that does nothing but sleep until the next millisecond.
// No pipeline on this machine can have a shorter tail.

using namespace pago;

namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

struct Core {
  LatencyHistogram late;
  std::string scheduling;
};

/// All cores at once: that is how the pipeline uses them.
std::vector<Core> measure(double seconds, int fifo_priority) {
  std::vector<std::unique_ptr<platform::JitterMeter>> meters;
  for (unsigned cpu = 0; cpu < std::thread::hardware_concurrency(); ++cpu)
    meters.push_back(std::make_unique<platform::JitterMeter>(
        perf::pinned("jitter", static_cast<int>(cpu), fifo_priority), kPeriod_ns));
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  std::vector<Core> cores;
  for (const auto& meter : meters) cores.push_back({meter->stop(), perf::scheduling_of(meter->thread())});
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
  std::printf("%s\n\nlateness of a timer of 1 ms, %.0f s, all cores at once, us\n\n",
              perf::context_line().c_str(), seconds);
  std::printf("| core | scheduling             |      p50 |      p90 |      p99 |     p99.9 |       max |\n");
  std::printf("|-----:|------------------------|---------:|---------:|---------:|----------:|----------:|\n");
  for (const int fifo_priority : {0, perf::kFifoPriority}) print(measure(seconds, fifo_priority));
  std::printf("\nafter the run: %s\n", perf::context_line().c_str());
}
