// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "pago/core/aligned_array.hpp"

namespace pago {

/// The memory orders of the queue's two hand-overs. Only the queue's own mutation test ever names another
/// one.
struct SpscOrders {
  static constexpr std::memory_order kPublish = std::memory_order_release;
  static constexpr std::memory_order kObserve = std::memory_order_acquire;
};

/// Bounded first-in-first-out queue between exactly one producer and one consumer thread. Lock-free and
/// wait-free: neither call ever blocks, allocates or makes a system call. Sleeping and waking live outside
/// (pipeline/channel.hpp).
///
/// Indices run free (uint32, wrap-around is well defined) and are masked on use, so the whole capacity is
/// usable. Each side keeps a copy of the other's index and looks again only when the copy says full or empty:
/// in steady state the two threads touch each other's cache lines once per lap, not once per element.
template <typename T, typename Orders = SpscOrders>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "elements are copied between threads as plain bytes");

 public:
  /// [set-up] Capacity is `min_capacity` (1 ... 2^31) rounded up to a power of two.
  explicit SpscQueue(std::uint32_t min_capacity)
      : slots_(std::bit_ceil(min_capacity)), mask_(std::bit_ceil(min_capacity) - 1) {}

  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// [producer thread] False and no change when full.
  bool try_push(const T& value) noexcept {
    // Relaxed: only this thread writes it.
    const std::uint32_t write = write_.load(std::memory_order_relaxed);
    if (write - read_seen_ == capacity()) {
      // Acquire, pairs with the publish in try_pop: the consumer's read of the slot happens before our
      // overwrite of it.
      read_seen_ = read_.load(Orders::kObserve);
      if (write - read_seen_ == capacity()) return false;
    }
    slots_[write & mask_] = value;
    // Release, pairs with the observe in try_pop: who sees the new index sees the slot's contents.
    write_.store(write + 1, Orders::kPublish);
    return true;
  }

  /// [consumer thread] False and no change when empty.
  bool try_pop(T& value) noexcept {
    // Relaxed: only this thread writes it.
    const std::uint32_t read = read_.load(std::memory_order_relaxed);
    if (read == write_seen_) {
      // Acquire, pairs with the publish in try_push.
      write_seen_ = write_.load(Orders::kObserve);
      if (read == write_seen_) return false;
    }
    value = slots_[read & mask_];
    // Release, pairs with the observe in try_push: our copy is taken before the slot counts as free.
    read_.store(read + 1, Orders::kPublish);
    return true;
  }

  /// [any thread] A value that was true at some moment during the call; exact for producer and consumer when
  /// the other side is idle.
  std::uint32_t size() const noexcept {
    const std::uint32_t read = read_.load(std::memory_order_acquire);
    return write_.load(std::memory_order_acquire) - read;
  }
  std::uint32_t capacity() const noexcept { return mask_ + 1; }

 private:
  AlignedArray<T> slots_;
  std::uint32_t mask_;
  alignas(kCacheLineBytes) std::atomic<std::uint32_t> write_{0};  // the producer's line
  std::uint32_t read_seen_ = 0;
  alignas(kCacheLineBytes) std::atomic<std::uint32_t> read_{0};  // the consumer's line
  std::uint32_t write_seen_ = 0;
};

}  // namespace pago
