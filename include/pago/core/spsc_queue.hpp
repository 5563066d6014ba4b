// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "pago/core/aligned_array.hpp"

namespace pago {

/// The memory orders of the queue's two hand-overs, elements there and free slots back, each published on one
/// side and observed on the other. Only the queue's own mutation test ever names other ones.
struct SpscOrders {
  static constexpr std::memory_order kPublishElement = std::memory_order_release;
  static constexpr std::memory_order kObserveElement = std::memory_order_acquire;
  static constexpr std::memory_order kPublishFree = std::memory_order_release;
  static constexpr std::memory_order kObserveFree = std::memory_order_acquire;
};

/// Bounded first-in-first-out queue between exactly one producer and one consumer thread. Lock-free and
/// wait-free: neither call ever blocks, allocates or makes a system call. Sleeping and waking live outside
/// (platform/channel.hpp).
///
/// Indices run free (uint32, wrap-around is well defined) and are masked on use, so the whole capacity is
/// usable. Each side keeps a copy of the other's index and looks again only when the copy says full or empty:
/// in steady state the two threads touch each other's cache lines once per lap, not once per element.
template <typename T, typename Orders = SpscOrders>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "elements are copied between threads as plain bytes");

 public:
  /// [set-up] Capacity is `min_capacity` (1 ... 2^31) rounded up to a power of two. Where the indices start
  /// matters to nobody but the test of their wrap-around.
  explicit SpscQueue(std::uint32_t min_capacity, std::uint32_t first_index = 0)
      : slots_(std::bit_ceil(min_capacity)),
        mask_(std::bit_ceil(min_capacity) - 1),
        write_(first_index),
        read_seen_(first_index),
        read_(first_index),
        write_seen_(first_index) {}

  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// [producer thread] False and no change when full.
  bool try_push(const T& value) noexcept {
    // Relaxed: only this thread writes it.
    const std::uint32_t write = write_.load(std::memory_order_relaxed);
    if (write - read_seen_ == capacity()) {
      // Acquire, pairs with the release in try_pop: the consumer's read of the slot happens before our
      // overwrite of it.
      read_seen_ = read_.load(Orders::kObserveFree);
      if (write - read_seen_ == capacity()) return false;
    }
    slots_[write & mask_] = value;
    // Release, pairs with the acquire in try_pop: who sees the new index sees the slot's contents.
    write_.store(write + 1, Orders::kPublishElement);
    return true;
  }

  /// [consumer thread] False and no change when empty.
  bool try_pop(T& value) noexcept {
    // Relaxed: only this thread writes it.
    const std::uint32_t read = read_.load(std::memory_order_relaxed);
    if (read == write_seen_) {
      // Acquire, pairs with the release in try_push.
      write_seen_ = write_.load(Orders::kObserveElement);
      if (read == write_seen_) return false;
    }
    value = slots_[read & mask_];
    // Release, pairs with the acquire in try_push: our copy is taken before the slot counts as free.
    read_.store(read + 1, Orders::kPublishFree);
    return true;
  }

  /// [producer or consumer thread] How many elements there were at some moment during the call. [any other
  /// thread] Not fewer than there were at its end, and at most as many more as were popped during it: a
  /// gauge. Never above capacity().
  std::uint32_t size() const noexcept {
    // Read index first, with acquire: the write index loaded after it is then at least the one that its
    // consumer had seen, so the difference cannot fall below zero. Popped and refilled in between, it can
    // exceed the capacity.
    const std::uint32_t read = read_.load(std::memory_order_acquire);
    return std::min(write_.load(std::memory_order_acquire) - read, capacity());
  }
  std::uint32_t capacity() const noexcept { return mask_ + 1; }

 private:
  AlignedArray<T> slots_;
  std::uint32_t mask_;
  alignas(kCacheLineBytes) std::atomic<std::uint32_t> write_;  // the producer's line
  std::uint32_t read_seen_;
  alignas(kCacheLineBytes) std::atomic<std::uint32_t> read_;  // the consumer's line
  std::uint32_t write_seen_;
};

}  // namespace pago
