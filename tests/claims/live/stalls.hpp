// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Stalls planted in a pipeline's thread. The program must be linked with --wrap=clock_gettime: every stage
// reads its thread's CPU time through it for each sweep, and there the thread is put to sleep. Included by
// one file.

#include <atomic>
#include <cstring>
#include <ctime>

#include "pago/platform/clock.hpp"
#include "pago/platform/thread.hpp"

namespace pago::claims {

/// Which thread, how long, how often. Set before the threads start.
struct Stall {
  const char* thread = "";
  std::int64_t length_ns = 0, every_ns = 0;
};
inline Stall stall;
inline std::atomic<int> num_stalls{0};

}  // namespace pago::claims

extern "C" int __real_clock_gettime(clockid_t clock, timespec* time);
extern "C" int __wrap_clock_gettime(clockid_t clock, timespec* time) {
  using namespace pago::claims;
  thread_local std::int64_t next_ns = 0;
  const bool is_asked =
      stall.every_ns > 0 && std::strcmp(pago::platform::current_thread_name(), stall.thread) == 0;
  if (is_asked && clock != CLOCK_MONOTONIC) {
    timespec now{};
    __real_clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
    if (next_ns == 0) next_ns = now_ns + stall.every_ns;
    if (now_ns >= next_ns) {
      next_ns = now_ns + stall.length_ns + stall.every_ns;
      ++num_stalls;
      const timespec length{.tv_sec = 0, .tv_nsec = stall.length_ns};
      nanosleep(&length, nullptr);
    }
  }
  return __real_clock_gettime(clock, time);
}
