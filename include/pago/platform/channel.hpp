// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/core/spsc_queue.hpp"
#include "pago/platform/wakeup.hpp"

namespace pago::platform {

/// How one thread hands elements to another: a bounded queue at whose either end the thread may sleep. One
/// producer thread, one consumer thread. Each call does its queue operation first and notifies the other side
/// after it, which is what Wakeup asks for; so no wake-up is lost at either end.
///
/// The end of a stream is an element of its own (a null sweep), so that everything before it is worked off.
///
/// Real-time safe: the calls that do not wait never block; waking a sleeper costs about 20 us.
template <typename T>
class Channel {
 public:
  /// [set-up] Capacity is `min_capacity` rounded up to a power of two.
  explicit Channel(std::uint32_t min_capacity) : queue_(min_capacity) {}

  /// [producer thread] False and no change when full.
  bool try_push(const T& value) noexcept {
    if (!queue_.try_push(value)) return false;
    not_empty_.notify();
    return true;
  }

  /// [producer thread] Sleeps while full; false after `timeout_ns` without change. For replays, where the
  /// source waits; a live source never does.
  bool push_wait(const T& value, std::int64_t timeout_ns) noexcept {
    if (!not_full_.wait_for([&] { return queue_.try_push(value); }, timeout_ns)) return false;
    not_empty_.notify();
    return true;
  }

  /// [consumer thread] False and no change when empty.
  bool try_pop(T& value) noexcept {
    if (!queue_.try_pop(value)) return false;
    not_full_.notify();
    return true;
  }

  /// [consumer thread] Sleeps while empty; false after `timeout_ns` without an element.
  bool pop_wait(T& value, std::int64_t timeout_ns) noexcept {
    if (!not_empty_.wait_for([&] { return queue_.try_pop(value); }, timeout_ns)) return false;
    not_full_.notify();
    return true;
  }

  /// As SpscQueue::size().
  std::uint32_t size() const noexcept { return queue_.size(); }
  std::uint32_t capacity() const noexcept { return queue_.capacity(); }

 private:
  SpscQueue<T> queue_;
  alignas(kCacheLineBytes) Wakeup not_empty_;
  alignas(kCacheLineBytes) Wakeup not_full_;
};

}  // namespace pago::platform
