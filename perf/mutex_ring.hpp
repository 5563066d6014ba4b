// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace pago::perf {

/// The queue that one would write first: what the lock-free ones are measured against.
class MutexRing {
 public:
  explicit MutexRing(std::size_t capacity) : slots_(capacity) {}

  bool try_push(std::uint64_t value) {
    const std::scoped_lock lock(mutex_);
    if (size_ == slots_.size()) return false;
    slots_[(first_ + size_++) % slots_.size()] = value;
    return true;
  }

  bool try_pop(std::uint64_t& value) {
    const std::scoped_lock lock(mutex_);
    if (size_ == 0) return false;
    value = slots_[first_];
    first_ = (first_ + 1) % slots_.size();
    --size_;
    return true;
  }

 private:
  std::mutex mutex_;
  std::vector<std::uint64_t> slots_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace pago::perf
