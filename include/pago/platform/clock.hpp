// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

#include <cstdint>

namespace pago::platform {

inline std::int64_t read_clock_ns(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

/// [any thread] For durations and deadlines: never set back, starts at boot. About 30 ns, no system call.
inline std::int64_t monotonic_ns() noexcept {
  return read_clock_ns(CLOCK_MONOTONIC);
}
/// [any thread] Since the Unix epoch; what packet arrivals are stamped with. May be set by NTP or an
/// operator.
inline std::int64_t realtime_ns() noexcept {
  return read_clock_ns(CLOCK_REALTIME);
}
/// [any thread] CPU time that the calling thread has used. A system call of about 0.6 us: once per stage, not
/// per packet.
inline std::int64_t thread_cpu_ns() noexcept {
  return read_clock_ns(CLOCK_THREAD_CPUTIME_ID);
}

/// [any thread] Sleeps until the monotonic clock shows `at_ns`; returns at once if it already does, and early
/// if a signal comes. One system call, about 50 us of wake-up.
inline void sleep_until_ns(std::int64_t at_ns) noexcept {
  const timespec until{.tv_sec = at_ns / 1'000'000'000, .tv_nsec = at_ns % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace pago::platform
