// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pago::ground {

/// Scrambles a number: the output function of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
constexpr std::uint64_t scramble(std::uint64_t x) noexcept {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
  return x ^ x >> 31U;
}

/// A number in [0, 1) made of it.
constexpr double unit_interval(std::uint64_t scrambled) noexcept {
  return static_cast<double>(scrambled >> 11U) * 0x1p-53;
}

/// SplitMix64: the same numbers on every machine, which the standard library's distributions do not promise.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : state_(scramble(seed)) {}

  /// In [0, bound), where bound is at most 2^32.
  constexpr std::uint64_t below(std::uint64_t bound) noexcept { return (next() >> 32U) * bound >> 32U; }

 private:
  constexpr std::uint64_t next() noexcept {
    const std::uint64_t result = scramble(state_);
    state_ += 0x9E3779B97F4A7C15U;
    return result;
  }
  std::uint64_t state_;
};

}  // namespace pago::ground
