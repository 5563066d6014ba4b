// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "support/alloc_guard.hpp"

#include <malloc.h>

#include <Eigen/Core>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "pago/core/histogram.hpp"
#include "pago/core/se3.hpp"
#include "pago/platform/channel.hpp"
#include "pago/platform/thread.hpp"
#include "support/catch.hpp"

using namespace pago::platform;
using pago::test::AllocationGuard;
using pago::test::RealtimeThreads;

namespace {

/// Keeps the compiler from removing a pair of new and delete.
template <typename T>
T* used(T* pointer) {
  asm volatile("" : "+r"(pointer) : : "memory");
  return pointer;
}

struct Counted {
  std::uint64_t allocations = 0, frees = 0;
  bool operator==(const Counted&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Counted& c) {
  return out << c.allocations << " allocations, " << c.frees << " frees";
}

template <typename Work>
Counted count(Work&& work) {
  const AllocationGuard guard;
  work();
  return {guard.allocations(), guard.frees()};
}

constexpr Counted kOneEach{1, 1};
/// g++ 12's ThreadSanitizer reports aligned memory only when it is freed.
#if defined(__SANITIZE_THREAD__)
constexpr Counted kOneEachAligned{0, 1};
#else
constexpr Counted kOneEachAligned = kOneEach;
#endif
constexpr std::int64_t kNever_ns = 60'000'000'000;

/// What a pipeline's thread does, without the sensor.
void hand_over(Channel<int>& from, Channel<int>& to, int count) {
  for (int i = 0; i < count; ++i) {
    int value = 0;
    from.pop_wait(value, kNever_ns);
    to.push_wait(value + 1, kNever_ns);
  }
}

}  // namespace

TEST_CASE("every member of the malloc family is counted", "[support][alloc_guard]") {
  CHECK(count([] { std::free(used(std::malloc(100))); }) == kOneEach);
  CHECK(count([] { std::free(used(std::calloc(10, 10))); }) == kOneEach);
  CHECK(count([] { std::free(used(std::aligned_alloc(64, 128))); }) == kOneEachAligned);
  CHECK(count([] { std::free(used(memalign(64, 128))); }) == kOneEachAligned);
  CHECK(count([] { std::free(used(valloc(128))); }) == kOneEachAligned);
  CHECK(count([] { std::free(used(strdup("a string of the C library's own making"))); }) == kOneEach);
  CHECK(count([] {
          void* memory = nullptr;
          if (posix_memalign(&memory, 64, 128) == 0) std::free(used(memory));
        }) == kOneEachAligned);
  CHECK(count([] { std::free(used(reallocarray(nullptr, 10, 10))); }).allocations == 1);
  void* const memory = std::malloc(10);
  CHECK(count([&] { std::free(used(std::realloc(memory, 100'000))); }).allocations == 1);
}

TEST_CASE("every form of new and delete is counted", "[support][alloc_guard]") {
  struct alignas(64) Line {
    char bytes[64];
  };
  CHECK(count([] { delete used(new int); }) == kOneEach);
  CHECK(count([] { delete[] used(new int[100]); }) == kOneEach);
  CHECK(count([] { delete used(new Line); }) == kOneEach);
  CHECK(count([] { delete used(new (std::nothrow) int); }) == kOneEach);
  CHECK(count([] { ::operator delete(used(::operator new(10))); }) == kOneEach);
}

TEST_CASE("what allocates behind the scenes is counted", "[support][alloc_guard]") {
  CHECK(count([] { used(std::vector<int>(100).data()); }) == kOneEach);
  CHECK(count([] { used(std::string(100, 'x').data()); }) == kOneEach);
  CHECK(count([] { used(std::make_shared<int>(1).get()); }) == kOneEach);
  CHECK(count([] { used(Eigen::VectorXd(100).data()); }) == kOneEach);
  std::array<double, 20> large{};
  CHECK(count([&] { std::function<double()>([large] { return large[0]; })(); }) == kOneEach);
  CHECK(count([] {
          try {
            throw 1;
          } catch (int) {
          }
        }) == kOneEach);
}

TEST_CASE("what does not touch the heap is not counted", "[support][alloc_guard]") {
  pago::LatencyHistogram histogram;
  Channel<int> channel(8);
  pago::Vector6d xi = pago::Vector6d::Constant(0.1);
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    int value = 0;
    histogram.record(i);
    channel.try_push(i);
    channel.try_pop(value);
    channel.pop_wait(value, 1000);
    xi = pago::log_se3(pago::exp_se3(xi));
  }
  std::free(used(static_cast<void*>(nullptr)));
  delete used(static_cast<int*>(nullptr));
  CHECK(guard.allocations() == 0);
  CHECK(guard.frees() == 0);
  CHECK(guard.count() == 0);
}

TEST_CASE("a guard counts its own thread alone", "[support][alloc_guard]") {
  Channel<int> channel(1);
  Thread other({.name = "other"}, [&] {
    int value = 0;
    channel.pop_wait(value, kNever_ns);
    for (int i = 0; i < 1000; ++i) std::free(used(std::malloc(100)));
  });
  const AllocationGuard guard;
  channel.try_push(1);
  other.join();
  CHECK(guard.count() == 0);
}

TEST_CASE("planted malloc and new on another thread are counted under its name", "[support][alloc_guard]") {
  const auto run = [](const char* name, auto work) { Thread({.name = name}, work).join(); };
  const auto use_malloc = [] { std::free(used(std::malloc(100))); };
  const auto use_new = [] { delete used(new int); };

  RealtimeThreads::arm({"ingest", "front"});
  CHECK(RealtimeThreads::first_call().empty());
  const std::uint64_t start_and_end = [&] {
    run("front", [] {});
    return RealtimeThreads::count("front");
  }();
  run("front", use_malloc);
  CHECK(RealtimeThreads::count("front") == 2 * start_and_end + 2);
  run("front", use_new);
  CHECK(RealtimeThreads::count("front") == 3 * start_and_end + 4);
  run("publisher", use_new);
  CHECK(RealtimeThreads::count("ingest") == 0);
  CHECK(RealtimeThreads::first_call().find('\n') != std::string::npos);

  RealtimeThreads::disarm();
  run("front", use_new);
  CHECK(RealtimeThreads::count("front") == 3 * start_and_end + 4);
  RealtimeThreads::arm({"front"});
  CHECK(RealtimeThreads::count("front") == 0);
  RealtimeThreads::disarm();
}

TEST_CASE("threads that hand elements on call the heap only where that was planted",
          "[support][alloc_guard]") {
  const bool is_planted = GENERATE(false, true);
  constexpr int kCount = 2000;
  Channel<int> packets(4), sweeps(4), poses(4);
  Thread ingest({.name = "ingest"}, [&] { hand_over(packets, sweeps, kCount); });
  Thread front({.name = "front"}, [&] {
    hand_over(sweeps, poses, kCount / 2);
    if (is_planted) delete used(new int);
    hand_over(sweeps, poses, kCount / 2);
  });
  RealtimeThreads::arm({"ingest", "front"});
  int num_right = 0;
  for (int i = 0, pose = 0; i < kCount; ++i) {
    packets.push_wait(i, kNever_ns);
    poses.pop_wait(pose, kNever_ns);
    num_right += pose == i + 2 ? 1 : 0;
  }
  RealtimeThreads::disarm();
  CHECK(num_right == kCount);
  INFO(RealtimeThreads::first_call());
  CHECK(RealtimeThreads::count("ingest") == 0);
  CHECK(RealtimeThreads::count("front") == (is_planted ? 2 : 0));
}
