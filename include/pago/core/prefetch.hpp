// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pago/core/aligned_array.hpp"

namespace pago {

/// Asks for the cache line at `at`, which will be written soon. Any address will do: a hint never faults.
/// [any thread] real-time safe.
inline void prefetch_to_write(const void* at) noexcept {
#if defined(__x86_64__)
  // The built-in would ask for a line to read, and the store for it once more; a processor without this
  // instruction skips it.
  asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(at)));
#else
  __builtin_prefetch(at, 1);
#endif
}

/// Asks for all cache lines of `bytes`, which will be read soon.
inline void prefetch_to_read(std::span<const std::uint8_t> bytes) noexcept {
  for (std::size_t at = 0; at < bytes.size(); at += kCacheLineBytes) __builtin_prefetch(bytes.data() + at);
}

}  // namespace pago
