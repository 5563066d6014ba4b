// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <latch>
#include <string>

#include "mutex_ring.hpp"
#include "pago/core/spsc_queue.hpp"
#include "pago/platform/channel.hpp"
#include "pago/platform/clock.hpp"
#include "percentile.hpp"
#include "pinned.hpp"
#include "queues.hpp"

namespace pago::perf {

namespace {

constexpr std::uint32_t kCapacity = 1024;
constexpr int kBatches = 10, kRuns = 5;

/// Boost's queue by our verbs.
class BoostRing {
 public:
  explicit BoostRing(std::size_t capacity) : queue_(capacity) {}
  bool try_push(std::uint64_t value) { return queue_.push(value); }
  bool try_pop(std::uint64_t& value) { return queue_.pop(value); }

 private:
  boost::lockfree::spsc_queue<std::uint64_t> queue_;
};

using Own = SpscQueue<std::uint64_t>;
using OwnChannel = platform::Channel<std::uint64_t>;

/// A batch of results of one repetition: its median counts, since the machine may be busy during some.
void report(benchmark::State& state, const std::vector<double>& ns_per_element, bool in_order) {
  const double p50_ns = percentile(ns_per_element, 50.0);
  state.counters["element_ns"] = p50_ns;
  state.counters["million_s"] = 1e3 / p50_ns;
  if (!in_order) state.SkipWithError("elements were lost or out of order");
}

/// One thread puts an element in and takes it out: the bare cost of the two calls.
template <typename Queue>
void alone(benchmark::State& state) {
  constexpr std::uint64_t kElements = 1'000'000;
  Queue queue(kCapacity);
  std::vector<double> ns_per_element;
  bool in_order = true;
  for ([[maybe_unused]] auto _ : state) {
    const std::int64_t before_ns = platform::thread_cpu_ns();
    for (std::uint64_t i = 0; i < kElements; ++i) {
      std::uint64_t value = 0;
      in_order &= queue.try_push(i) && queue.try_pop(value) && value == i;
    }
    const auto took_ns = static_cast<double>(platform::thread_cpu_ns() - before_ns);
    state.SetIterationTime(took_ns * 1e-9);
    ns_per_element.push_back(took_ns / static_cast<double>(kElements));
  }
  report(state, ns_per_element, in_order);
}

/// A thread pushes as fast as it can, another pops: nanoseconds from the first element's arrival to the
/// last's.
template <typename Queue>
double transfer_ns(Queue& queue, std::uint64_t elements, bool& in_order, std::string& scheduling) {
  // On a single core the one that spins would keep the other from running.
  const int priority = std::thread::hardware_concurrency() > 1 ? kFifoPriority : 0;
  std::latch start(2);
  std::int64_t took_ns = 0;
  platform::Thread consumer(pinned("consumer", 1, priority), [&] {
    start.arrive_and_wait();
    std::int64_t first_ns = 0;
    for (std::uint64_t i = 0; i < elements; ++i) {
      std::uint64_t value = 0;
      while (!queue.try_pop(value)) {
      }
      if (i == 0) first_ns = platform::monotonic_ns();
      in_order &= value == i;
    }
    took_ns = platform::monotonic_ns() - first_ns;
  });
  platform::Thread producer(pinned("producer", 0, priority), [&] {
    start.arrive_and_wait();
    for (std::uint64_t i = 0; i < elements; ++i) {
      while (!queue.try_push(i)) {
      }
    }
  });
  scheduling = scheduling_of(consumer);
  consumer.join();
  return static_cast<double>(took_ns);
}

template <typename Queue>
void across(benchmark::State& state) {
  constexpr std::uint64_t kElements = 500'000;
  Queue queue(kCapacity);
  std::vector<double> ns_per_element;
  std::string scheduling;
  bool in_order = true;
  for ([[maybe_unused]] auto _ : state) {
    const double took_ns = transfer_ns(queue, kElements, in_order, scheduling);
    state.SetIterationTime(took_ns * 1e-9);
    ns_per_element.push_back(took_ns / static_cast<double>(kElements));
  }
  state.SetLabel(scheduling);
  report(state, ns_per_element, in_order);
}

void add(const char* name, void (*body)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, body)->UseManualTime()->Iterations(kBatches)->Repetitions(kRuns);
}

}  // namespace

void register_throughput() {
  add("one thread: SpscQueue", alone<Own>);
  add("one thread: Channel", alone<OwnChannel>);
  add("one thread: boost spsc_queue", alone<BoostRing>);
  add("one thread: mutex ring", alone<MutexRing>);
  add("two threads: SpscQueue", across<Own>);
  add("two threads: Channel", across<OwnChannel>);
  add("two threads: boost spsc_queue", across<BoostRing>);
  add("two threads: mutex ring", across<MutexRing>);
}

}  // namespace pago::perf
