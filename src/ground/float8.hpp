// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pago::ground {

/// Eight floats that are worked on at once. A vector type of the compiler (g++ and clang; one AVX register,
/// two of NEON): sums are taken in the same eight lanes on every machine, and wherever in memory the values
/// lie. Comparisons give an Int8 whose lanes are -1 or 0; `mask ? a : b` chooses lane by lane.
using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
inline constexpr std::size_t kLanes = 8;

// References instead of values: how vectors are passed depends on the machine.
inline void load(const float* from, Float8& to) noexcept {
  std::memcpy(&to, from, sizeof to);
}
inline void store(const Float8& from, float* to) noexcept {
  std::memcpy(to, &from, sizeof from);
}

/// The first `count` (at most 8) lanes from memory, the rest `fill`.
inline void load_part(const float* from, std::size_t count, float fill, Float8& to) noexcept {
  for (std::size_t lane = 0; lane < kLanes; ++lane) to[lane] = lane < count ? from[lane] : fill;
}

inline float sum(const Float8& v) noexcept {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

}  // namespace pago::ground
