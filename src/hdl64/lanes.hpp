// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "pago/core/sweep.hpp"
#include "pago/hdl64/packet.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// The steps of decoding that compilers do not turn into vector code. `portable` says what they do; `avx2`
/// does the same several times faster.
namespace pago::hdl64 {

using RawLanes = std::array<std::int32_t, kLasers>;

namespace portable {

/// A block's 32 slots, two bytes distance and one byte intensity each; of the distance only `distance_bits`.
/// Reads one byte beyond a slot, which even behind the packet's last slot is still the packet's (its
/// trailer).
inline void unpack(const std::uint8_t* slots,
                   std::int32_t distance_bits,
                   std::int32_t* raw,
                   std::int32_t* intensity) noexcept {
  for (std::size_t j = 0; j < kLasersPerBlock; ++j) {
    std::uint32_t word = 0;
    std::memcpy(&word, slots + 3 * j, sizeof word);
    raw[j] = static_cast<std::int32_t>(word) & distance_bits;
    intensity[j] = static_cast<std::int32_t>(word >> 16U & 0xFFU);
  }
}

/// The set of lanes with first <= raw <= last.
inline std::uint64_t in_range(const RawLanes& raw, const RawLanes& first, const RawLanes& last) noexcept {
  std::uint64_t set = 0;
  for (std::size_t i = 0; i < kLasers; ++i)
    set |= std::uint64_t{raw[i] >= first[i] && raw[i] <= last[i]} << i;
  return set;
}

}  // namespace portable

#if defined(__AVX2__)
namespace avx2 {

inline __m256i load(const std::int32_t* at) noexcept {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(at));
}
inline __m128i load_16_bytes(const std::uint8_t* at) noexcept {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
}

/// Eight slots (24 bytes) at a time, as two overlapping loads of 16; the last one ends at the packet's byte
/// 1,204.
inline void unpack(const std::uint8_t* slots,
                   std::int32_t distance_bits,
                   std::int32_t* raw,
                   std::int32_t* intensity) noexcept {
  const __m128i spread = _mm_setr_epi8(0, 1, 2, -1, 3, 4, 5, -1, 6, 7, 8, -1, 9, 10, 11, -1);
  const __m256i bits = _mm256_set1_epi32(distance_bits);
  for (std::size_t j = 0; j < kLasersPerBlock; j += 8) {
    const __m128i first = _mm_shuffle_epi8(load_16_bytes(slots + 3 * j), spread);
    const __m128i second = _mm_shuffle_epi8(load_16_bytes(slots + 3 * j + 12), spread);
    const __m256i words = _mm256_set_m128i(second, first);
    _mm256_store_si256(reinterpret_cast<__m256i*>(raw + j), _mm256_and_si256(words, bits));
    _mm256_store_si256(reinterpret_cast<__m256i*>(intensity + j), _mm256_srli_epi32(words, 16));
  }
}

inline std::uint64_t in_range(const RawLanes& raw, const RawLanes& first, const RawLanes& last) noexcept {
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < kLasers; i += 8) {
    const __m256i lanes = load(raw.data() + i);
    const __m256i beyond = _mm256_or_si256(_mm256_cmpgt_epi32(load(first.data() + i), lanes),
                                           _mm256_cmpgt_epi32(lanes, load(last.data() + i)));
    const auto set = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(beyond)));
    outside |= std::uint64_t{set} << i;
  }
  return ~outside;
}

}  // namespace avx2
namespace fastest = avx2;
#else
namespace fastest = portable;
#endif

/// One firing as it stands in a packet, an entry per laser.
struct alignas(64) PacketLanes {
  RawLanes raw, intensity;

  /// Takes two blocks apart; one that is not there (-1) leaves its lasers without returns.
  void unpack(const PacketView& packet, int upper, int lower, std::int32_t distance_bits) noexcept {
    const std::array<int, 2> blocks{upper, lower};
    for (std::size_t half = 0; half < 2; ++half) {
      std::int32_t* const raw_half = raw.data() + half * kLasersPerBlock;
      std::int32_t* const intensity_half = intensity.data() + half * kLasersPerBlock;
      if (blocks[half] >= 0) {
        fastest::unpack(packet.slots(blocks[half]), distance_bits, raw_half, intensity_half);
      } else {
        std::fill_n(raw_half, kLasersPerBlock, 0);
        std::fill_n(intensity_half, kLasersPerBlock, 0);
      }
    }
  }
};

/// Two returns of each laser: the stronger one comes to be in `a`, the other one in `b`, or 0 there if it is
/// no return, or the same one again. A return outside its laser's range is none.
inline void sort_echoes(const RawLanes& first,
                        const RawLanes& last,
                        PacketLanes& __restrict a,
                        PacketLanes& __restrict b,
                        std::array<std::uint8_t, kLasers>& __restrict echo_a,
                        std::array<std::uint8_t, kLasers>& __restrict echo_b) noexcept {
  for (std::size_t i = 0; i < kLasers; ++i) {
    const std::int32_t raw_a = a.raw[i], raw_b = b.raw[i];
    const bool has_a = (raw_a >= first[i]) & (raw_a <= last[i]);
    const bool has_b = (raw_b >= first[i]) & (raw_b <= last[i]);
    const bool b_is_stronger = has_b & (!has_a | (b.intensity[i] > a.intensity[i]));
    const std::int32_t strong = b_is_stronger ? raw_b : raw_a;
    const std::int32_t strong_intensity = b_is_stronger ? b.intensity[i] : a.intensity[i];
    const std::int32_t weak = b_is_stronger ? raw_a : raw_b;
    const std::int32_t weak_intensity = b_is_stronger ? a.intensity[i] : b.intensity[i];
    const bool are_two = has_a & has_b & (raw_a != raw_b);
    const bool weak_is_last = weak > strong;
    a.raw[i] = strong;
    a.intensity[i] = strong_intensity;
    b.raw[i] = are_two ? weak : 0;
    b.intensity[i] = weak_intensity;
    echo_a[i] = (are_two & weak_is_last) ? kNotLast : 0;
    echo_b[i] = static_cast<std::uint8_t>(weak_is_last ? kNotStrongest : kNotStrongest | kNotLast);
  }
}

}  // namespace pago::hdl64
