// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "pago/core/aligned_array.hpp"
#include "pago/core/prefetch.hpp"
#include "pago/core/sweep.hpp"
#include "pago/hdl64/packet_decoder.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// How a firing, an entry per laser with gaps, gets into a sweep's arrays, which have none. `portable` says
/// what is done; `avx2` does the same several times faster.
namespace pago {

/// What a laser's returns have in common.
struct alignas(64) LaserLanes {
  std::array<std::int32_t, hdl64::kLasers> time_ns{};  ///< of the laser after the start of its firing
  /// Of its column against the firing's. Sums below zero are modulo 2^16 until the margins are folded.
  std::array<std::uint16_t, hdl64::kLasers> shift{};
  std::array<std::uint8_t, hdl64::kLasers> ring{};
};

/// Where the next return of a sweep goes; 64 entries of room behind it in every array.
struct ReturnSlots {
  float *x_m, *y_m, *z_m;
  std::uint8_t *intensity, *ring, *echo;
  std::uint16_t* column;
  std::int32_t* time_offset_ns;

  static ReturnSlots at(Sweep& sweep, std::uint32_t index) noexcept {
    return {.x_m = sweep.x_m.data() + index,
            .y_m = sweep.y_m.data() + index,
            .z_m = sweep.z_m.data() + index,
            .intensity = sweep.intensity.data() + index,
            .ring = sweep.ring.data() + index,
            .echo = sweep.echo.data() + index,
            .column = sweep.column.data() + index,
            .time_offset_ns = sweep.time_offset_ns.data() + index};
  }

  /// Asks for the memory of the firing after the next two: a sweep is larger than the nearer caches.
  void prefetch() const noexcept {
    constexpr std::size_t kAhead = 3 * hdl64::kLasers;
    const auto ask = [](const auto* array) {
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(array + kAhead);
      for (std::size_t at = 0; at < hdl64::kLasers * sizeof *array; at += kCacheLineBytes)
        prefetch_to_write(bytes + at);
    };
    ask(x_m), ask(y_m), ask(z_m), ask(time_offset_ns), ask(column), ask(intensity), ask(ring);
  }
};

/// Of a firing: its column and its time in the sweep.
struct FiringPlace {
  int column;
  std::int32_t offset_ns;
};

/// For each laser the index of its return, or RangeImage::kEmpty.
using CellLanes = std::array<std::int32_t, hdl64::kLasers>;

namespace portable {

/// Writes the valid returns in laser order, without echoes. What stands behind them is unspecified.
inline void append(const hdl64::FiringReturns& from,
                   const LaserLanes& lasers,
                   const FiringPlace& place,
                   const ReturnSlots& to) noexcept {
  std::size_t n = 0;
  for (std::size_t i = 0; i < hdl64::kLasers; ++i) {
    if ((from.valid >> i & 1U) == 0) continue;
    to.x_m[n] = from.x_m[i];
    to.y_m[n] = from.y_m[i];
    to.z_m[n] = from.z_m[i];
    to.intensity[n] = from.intensity[i];
    to.ring[n] = lasers.ring[i];
    to.column[n] = static_cast<std::uint16_t>(place.column + lasers.shift[i]);
    to.time_offset_ns[n] = place.offset_ns + lasers.time_ns[i];
    ++n;
  }
}

/// The echoes of the valid returns alone.
inline void append_echoes(const hdl64::FiringReturns& from, std::uint8_t* to) noexcept {
  std::size_t n = 0;
  for (std::size_t i = 0; i < hdl64::kLasers; ++i)
    if ((from.valid >> i & 1U) != 0) to[n++] = from.echo[i];
}

/// `first` is the index of the first valid return.
inline void number(std::uint64_t valid, std::uint32_t first, CellLanes& cells) noexcept {
  auto next = static_cast<std::int32_t>(first);
  for (std::size_t i = 0; i < hdl64::kLasers; ++i)
    cells[i] = (valid >> i & 1U) != 0 ? next++ : RangeImage::kEmpty;
}

}  // namespace portable

#if defined(__AVX2__)
namespace avx2 {

/// For each set of eight lanes, as a mask: the numbers of its members; and for each lane how many members
/// stand before it, -1 if it is none itself.
struct LaneSets {
  std::array<std::array<std::uint8_t, 8>, 256> members{};
  std::array<std::array<std::int8_t, 8>, 256> rank{};
};
inline constexpr LaneSets kSets = [] {
  LaneSets sets{};
  for (unsigned set = 0; set < 256; ++set) {
    std::uint8_t n = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      const bool is_member = (set >> lane & 1U) != 0;
      sets.rank[set][lane] = is_member ? static_cast<std::int8_t>(n) : std::int8_t{-1};
      if (is_member) sets.members[set][n++] = lane;
    }
  }
  return sets;
}();

inline std::size_t set_at(std::uint64_t valid, std::size_t lane) noexcept {
  return static_cast<std::size_t>(valid >> lane & 0xFFU);
}
inline __m128i load_8_bytes(const void* at) noexcept {
  return _mm_loadl_epi64(static_cast<const __m128i*>(at));
}
inline void keep_bytes(const std::uint8_t* from, __m128i members, std::uint8_t* to) noexcept {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(load_8_bytes(from), members));
}
inline void keep_floats(const float* from, __m256i members, float* to) noexcept {
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(_mm256_load_ps(from), members));
}

/// Eight lanes at a time; each writes eight entries and counts only its members, so that the next eight
/// overwrite the rest.
inline void append(const hdl64::FiringReturns& from,
                   const LaserLanes& lasers,
                   const FiringPlace& place,
                   const ReturnSlots& to) noexcept {
  const __m128i column = _mm_set1_epi16(static_cast<std::int16_t>(place.column));
  const __m256i offset_ns = _mm256_set1_epi32(place.offset_ns);
  std::size_t n = 0;
  for (std::size_t i = 0; i < hdl64::kLasers; i += 8) {
    const std::size_t set = set_at(from.valid, i);
    const __m128i members = load_8_bytes(kSets.members[set].data());
    const __m256i wide = _mm256_cvtepu8_epi32(members);
    keep_floats(from.x_m.data() + i, wide, to.x_m + n);
    keep_floats(from.y_m.data() + i, wide, to.y_m + n);
    keep_floats(from.z_m.data() + i, wide, to.z_m + n);
    keep_bytes(from.intensity.data() + i, members, to.intensity + n);
    keep_bytes(lasers.ring.data() + i, members, to.ring + n);
    // Two bytes a lane: member m is bytes 2m and 2m + 1.
    const __m128i low = _mm_add_epi8(members, members);
    const __m128i pairs = _mm_unpacklo_epi8(low, _mm_add_epi8(low, _mm_set1_epi8(1)));
    const auto* const shifts = reinterpret_cast<const __m128i*>(lasers.shift.data() + i);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to.column + n),
                     _mm_add_epi16(_mm_shuffle_epi8(_mm_load_si128(shifts), pairs), column));
    const auto* const times = reinterpret_cast<const __m256i*>(lasers.time_ns.data() + i);
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(to.time_offset_ns + n),
        _mm256_add_epi32(_mm256_permutevar8x32_epi32(_mm256_load_si256(times), wide), offset_ns));
    n += static_cast<std::size_t>(std::popcount(set));
  }
}

inline void append_echoes(const hdl64::FiringReturns& from, std::uint8_t* to) noexcept {
  std::size_t n = 0;
  for (std::size_t i = 0; i < hdl64::kLasers; i += 8) {
    const std::size_t set = set_at(from.valid, i);
    keep_bytes(from.echo.data() + i, load_8_bytes(kSets.members[set].data()), to + n);
    n += static_cast<std::size_t>(std::popcount(set));
  }
}

inline void number(std::uint64_t valid, std::uint32_t first, CellLanes& cells) noexcept {
  auto next = static_cast<std::int32_t>(first);
  for (std::size_t i = 0; i < hdl64::kLasers; i += 8) {
    const std::size_t set = set_at(valid, i);
    const __m256i rank = _mm256_cvtepi8_epi32(load_8_bytes(kSets.rank[set].data()));
    // A rank of -1 makes the sum -1 as well.
    const __m256i index =
        _mm256_or_si256(_mm256_add_epi32(rank, _mm256_set1_epi32(next)), _mm256_srai_epi32(rank, 31));
    _mm256_store_si256(reinterpret_cast<__m256i*>(cells.data() + i), index);
    next += std::popcount(set);
  }
}

}  // namespace avx2
namespace fastest = avx2;
#else
namespace fastest = portable;
#endif

static_assert(RangeImage::kEmpty == -1);

}  // namespace pago
