// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "pago/platform/channel.hpp"
#include "pago/platform/clock.hpp"
#include "percentile.hpp"
#include "pinned.hpp"
#include "queues.hpp"

namespace pago::perf {

namespace {

constexpr int kHandOvers = 1000, kRepetitions = 3;
constexpr std::int64_t kPeriod_ns = 2'000'000;

struct HandOvers {
  std::vector<double> latency_us;  ///< from before the push to after the pop
  std::vector<double> push_us;     ///< what the producer spends: it wakes the other thread
  std::string scheduling;
};

void consume(platform::Channel<std::int64_t>& channel, HandOvers& result) {
  for (int i = 0; i < kHandOvers; ++i) {
    std::int64_t pushed_ns = 0;
    while (!channel.pop_wait(pushed_ns, 10 * kPeriod_ns)) {
    }
    result.latency_us.push_back(static_cast<double>(platform::monotonic_ns() - pushed_ns) * 1e-3);
  }
}

void produce(platform::Channel<std::int64_t>& channel, HandOvers& result) {
  std::int64_t due_ns = platform::monotonic_ns();
  for (int i = 0; i < kHandOvers; ++i) {
    platform::sleep_until_ns(due_ns += kPeriod_ns);
    const std::int64_t now_ns = platform::monotonic_ns();
    while (!channel.try_push(now_ns)) {
    }
    result.push_us.push_back(static_cast<double>(platform::monotonic_ns() - now_ns) * 1e-3);
  }
}

/// An element every 2 ms, so that the consumer has gone to sleep each time.
HandOvers hand_over(int fifo_priority) {
  HandOvers result;
  result.latency_us.reserve(kHandOvers);
  result.push_us.reserve(kHandOvers);
  platform::Channel<std::int64_t> channel(16);
  platform::Thread consumer(pinned("consumer", 1, fifo_priority), [&] { consume(channel, result); });
  platform::Thread producer(pinned("producer", 0, fifo_priority), [&] { produce(channel, result); });
  result.scheduling = scheduling_of(consumer);
  producer.join();
  consumer.join();
  return result;
}

void measure_hand_over(benchmark::State& state, int fifo_priority) {
  for ([[maybe_unused]] auto _ : state) {
    const HandOvers result = hand_over(fifo_priority);
    state.SetIterationTime(percentile(result.latency_us, 50.0) * 1e-6);
    state.SetLabel(result.scheduling);
    state.counters["p50_us"] = percentile(result.latency_us, 50.0);
    state.counters["p90_us"] = percentile(result.latency_us, 90.0);
    state.counters["p99_us"] = percentile(result.latency_us, 99.0);
    state.counters["push_us"] = percentile(result.push_us, 50.0);
  }
}

void add(const char* name, int fifo_priority) {
  benchmark::RegisterBenchmark(name,
                               [=](benchmark::State& state) { measure_hand_over(state, fifo_priority); })
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(kRepetitions);
}

}  // namespace

void register_hand_over() {
  add("wake-up: Channel", 0);
  add("wake-up: Channel, real-time", kFifoPriority);
}

}  // namespace pago::perf
