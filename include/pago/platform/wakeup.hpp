// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "pago/platform/clock.hpp"

namespace pago::platform {

/// Lets one thread sleep until another has changed something: a futex with timeout. Notifying makes a system
/// call only if somebody sleeps (about 20 us; otherwise one atomic exchange).
///
/// What is waited for is not in here but in a condition that the waiter passes and notifiers make true
/// *before* they call notify(): "the queue has an element".
///
/// No wake-up is ever lost: after notify() the waiter looks at its condition once more, with the change
/// visible, before it sleeps again. Why: both sides only ever *exchange* `sleeping_`, so all exchanges have
/// one order, and each (acquire and release) synchronises with the next. The waiter looks between each
/// exchange(1) and its sleep. If the notifier's exchange(0) returns
///  - 1: it calls the kernel. A waiter that is asleep wakes; one that is not yet is refused by the kernel,
///    which finds 0 where the waiter said 1. Its next exchange synchronises with ours, and it looks.
///  - 0: the waiter is on its way to another exchange(1), which will synchronise with ours, and it looks
///  after
///    that; or another notifier has taken the 1 and is about to wake it, as above.
///
/// [one waiting thread] wait_until, wait_for; [any thread] notify. Real-time safe.
class Wakeup {
 public:
  Wakeup() = default;
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  /// After the condition was made true.
  void notify() noexcept {
    if (sleeping_.exchange(0, std::memory_order_acq_rel) != 0) wake();
  }

  /// True as soon as `ready()` is, false when the monotonic clock has passed `deadline_ns` and it still is
  /// not. `ready` runs on this thread, any number of times until it is true once and never again: it may take
  /// what it finds.
  template <typename Ready>
  bool wait_until(Ready&& ready, std::int64_t deadline_ns) noexcept {
    if (ready()) return true;
    bool is_in_time = true;
    while (is_in_time) {
      sleeping_.exchange(1, std::memory_order_acq_rel);
      const bool is_ready = ready();
      if (!is_ready) is_in_time = sleep_until(deadline_ns);
      // Nobody sleeps any more: spares the next notifier its system call.
      sleeping_.exchange(0, std::memory_order_acq_rel);
      if (is_ready || ready()) return true;
    }
    return false;
  }

  /// The same, `timeout_ns` (0 ... 10^18) from now.
  template <typename Ready>
  bool wait_for(Ready&& ready, std::int64_t timeout_ns) noexcept {
    if (ready()) return true;
    return wait_until(ready, monotonic_ns() + timeout_ns);
  }

 private:
  void wake() noexcept;
  /// False once the deadline has passed; true may be spurious.
  bool sleep_until(std::int64_t deadline_ns) noexcept;

  std::atomic<std::uint32_t> sleeping_{0};
  static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t),
                "a futex is a plain 32-bit word");
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

/// Wakes every thread, of whatever process, that sleeps on this word of shared memory (futex(2), without
/// FUTEX_PRIVATE_FLAG). [any thread] real-time safe; 0.3 us when nobody sleeps.
void wake_sharers(std::atomic<std::uint32_t>& word) noexcept;

}  // namespace pago::platform
