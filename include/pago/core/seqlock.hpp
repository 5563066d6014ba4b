// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pago {

/// The newest value of one writer, for any number of readers: also of other processes, as it is plain memory
/// without pointers and its zero bytes are a slot that holds nothing yet. Writing never waits and makes no
/// system call; a reader that meets a write half done tries again. Every word of the value is an atomic of
/// its own, so that a torn copy is discarded rather than undefined (Boehm, "Can seqlocks get along with
/// programming language memory models?", MSPC 2012).
template <typename T>
class Seqlock {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0, "kept as 64-bit words");
  static constexpr std::size_t kWords = sizeof(T) / 8;

 public:
  /// [writer thread] real-time safe: one store per word.
  void store(const T& value) noexcept {
    std::array<std::uint64_t, kWords> words;
    std::memcpy(words.data(), &value, sizeof(T));
    const std::uint64_t version = version_.load(std::memory_order_relaxed);  // only this thread writes it
    version_.store(version + 1, std::memory_order_relaxed);
    // Release: who sees one of these words sees the odd version too.
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    // Release: who sees this even version sees all words.
    version_.store(version + 2, std::memory_order_release);
  }

  /// [any thread] True and a whole value, or false: nothing was stored yet, or a write was under way.
  bool try_load(T& value) const noexcept {
    // Acquire, pairs with the release of the even version.
    const std::uint64_t before = version_.load(std::memory_order_acquire);
    if (before == 0 || before % 2 != 0) return false;
    std::array<std::uint64_t, kWords> words;
    // Acquire, pairs with the release of each word: one of a newer value shows its version to the load below.
    for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
    if (version_.load(std::memory_order_relaxed) != before) return false;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }

  /// [any thread] How often a value was stored.
  std::uint64_t count() const noexcept { return version_.load(std::memory_order_acquire) / 2; }

 private:
  std::atomic<std::uint64_t> version_{0};  // odd while a write is under way
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace pago
