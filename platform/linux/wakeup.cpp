// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/wakeup.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>

namespace pago::platform {

void Wakeup::wake() noexcept {
  syscall(SYS_futex, &sleeping_, FUTEX_WAKE | FUTEX_PRIVATE_FLAG, 1, nullptr, nullptr, 0);
}

/// FUTEX_WAIT_BITSET takes an absolute time (FUTEX_WAIT a relative one, which a signal would restart), by
/// default of the monotonic clock: futex(2).
bool Wakeup::sleep_until(std::int64_t deadline_ns) noexcept {
  const std::int64_t at_ns = std::max<std::int64_t>(0, deadline_ns);
  const timespec deadline{.tv_sec = at_ns / 1'000'000'000, .tv_nsec = at_ns % 1'000'000'000};
  const long result = syscall(SYS_futex, &sleeping_, FUTEX_WAIT_BITSET | FUTEX_PRIVATE_FLAG, 1, &deadline,
                              nullptr, FUTEX_BITSET_MATCH_ANY);
  return result == 0 || errno != ETIMEDOUT;
}

void wake_sharers(std::atomic<std::uint32_t>& word) noexcept {
  syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace pago::platform
