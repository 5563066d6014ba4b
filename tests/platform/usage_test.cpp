// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/usage.hpp"

#include <sys/mman.h>

#include <atomic>

#include "pago/platform/clock.hpp"
#include "pago/platform/thread.hpp"
#include "support/catch.hpp"

using namespace pago::platform;

namespace {

constexpr std::size_t kPageBytes = 4096, kPages = 64;

/// Fresh pages that the kernel has not yet backed with memory.
volatile char* map_untouched() {
  void* const memory =
      mmap(nullptr, kPages * kPageBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  madvise(memory, kPages * kPageBytes, MADV_NOHUGEPAGE);
  return static_cast<volatile char*>(memory);
}

void touch(volatile char* memory) {
  for (std::size_t i = 0; i < kPages; ++i) memory[i * kPageBytes] = 1;
}

}  // namespace

TEST_CASE("the first touch of a page is a fault, the second is not", "[platform][usage]") {
  volatile char* const memory = map_untouched();
  const std::int64_t before = thread_minor_faults();
  touch(memory);
  const std::int64_t first = thread_minor_faults();
  touch(memory);
  const std::int64_t second = thread_minor_faults();
  CHECK(first - before >= static_cast<std::int64_t>(kPages));
  CHECK(second == first);
  munmap(const_cast<char*>(memory), kPages * kPageBytes);
}

TEST_CASE("faults are counted for the thread that takes them", "[platform][usage]") {
  volatile char* const memory = map_untouched();
  std::atomic<bool> go{false};
  std::int64_t faults = -1;
  Thread thread({.name = "faulty"}, [&] {
    go.wait(false);
    const std::int64_t begin = thread_minor_faults();
    touch(memory);
    faults = thread_minor_faults() - begin;
  });
  const std::int64_t before = thread_minor_faults();
  go = true;
  go.notify_one();
  thread.join();
  CHECK(faults >= static_cast<std::int64_t>(kPages));
  CHECK(thread_minor_faults() - before < static_cast<std::int64_t>(kPages));
  munmap(const_cast<char*>(memory), kPages * kPageBytes);
}

TEST_CASE("a thread's touched stack takes no fault when it is used", "[platform][usage]") {
  std::int64_t faults = -1;
  Thread({.name = "deep"}, [&] {
    const std::int64_t begin = thread_minor_faults();
    volatile char deep[256 * 1024];
    for (std::size_t i = 0; i < sizeof(deep); i += kPageBytes) deep[i] = 1;
    faults = thread_minor_faults() - begin;
  }).join();
  CHECK(faults == 0);
}

TEST_CASE("the clocks run forward, and CPU time counts only work", "[platform][clock]") {
  const std::int64_t monotonic = monotonic_ns(), cpu = thread_cpu_ns();
  while (monotonic_ns() - monotonic < 2'000'000) {
  }
  CHECK(thread_cpu_ns() > cpu);
  CHECK(thread_cpu_ns() - cpu <= monotonic_ns() - monotonic + 1'000'000);
  CHECK(realtime_ns() > 1'600'000'000LL * 1'000'000'000LL);
  CHECK(peak_resident_bytes() > 1'000'000);
}
