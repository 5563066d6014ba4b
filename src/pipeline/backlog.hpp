// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

namespace pago {

/// Numbers that rise, gone through once beside others that rise: decisions of a recorded run.
class Recorded {
 public:
  Recorded() = default;
  explicit Recorded(std::span<const std::uint64_t> numbers) noexcept : rest_(numbers) {}

  /// Whether `number` is among them; to be asked with rising numbers.
  bool has(std::uint64_t number) noexcept {
    while (!rest_.empty() && rest_.front() < number) rest_ = rest_.subspan(1);
    return !rest_.empty() && rest_.front() == number;
  }

 private:
  std::span<const std::uint64_t> rest_;
};

/// Complete sweeps that wait in front of a thread, and which of them it passes over: while more than
/// `max_pending` wait, all but the newest (a stale pose is worth less than a fresh one after a gap). 0 never
/// passes over any by itself: a replay waits instead, and repeats what was recorded.
class Backlog {
 public:
  explicit Backlog(int max_pending, Recorded recorded = {}) noexcept
      : max_pending_(max_pending), recorded_(recorded) {}

  /// [producer thread] Another sweep is complete; before it is pushed.
  void arrived() noexcept { arrived_.fetch_add(1, std::memory_order_release); }

  /// [consumer thread] Once for each sweep, in order, before work on it begins. A sweep that is passed over
  /// is complete: the acquire pairs with arrived().
  bool passes_over(std::uint64_t sequence) noexcept {
    if (max_pending_ == 0) return recorded_.has(sequence);
    // One that comes in parts may be begun before it has arrived: then -1 wait.
    const auto waiting = static_cast<std::int32_t>(arrived_.load(std::memory_order_acquire) - begun_);
    ++begun_;
    is_skipping_ = waiting > (is_skipping_ ? 1 : max_pending_);
    return is_skipping_;
  }

 private:
  std::int32_t max_pending_;
  Recorded recorded_;
  std::atomic<std::uint32_t> arrived_{0};
  std::uint32_t begun_ = 0;
  bool is_skipping_ = false;
};

}  // namespace pago
