// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "image_tile.hpp"

namespace pago {

namespace {

#if defined(__AVX2__)
__m256i load(const std::int32_t* at) noexcept {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(at));
}

/// Eight firings' cells of eight lasers, turned around: laser i's go to `to[cell[i]]` and the seven behind.
void transpose_8x8(const std::array<CellLanes, ImageTile::kColumns>& cells,
                   std::size_t firing,
                   std::size_t laser,
                   std::int32_t* to,
                   const std::int32_t* cell) noexcept {
  __m256i pairs[8], fours[8];  // std::array would lose their alignment
  for (std::size_t i = 0; i < 8; i += 2) {
    const __m256i a = load(cells[firing + i].data() + laser), b = load(cells[firing + i + 1].data() + laser);
    pairs[i] = _mm256_unpacklo_epi32(a, b);
    pairs[i + 1] = _mm256_unpackhi_epi32(a, b);
  }
  for (std::size_t i = 0; i < 8; i += 4) {
    fours[i] = _mm256_unpacklo_epi64(pairs[i], pairs[i + 2]);
    fours[i + 1] = _mm256_unpackhi_epi64(pairs[i], pairs[i + 2]);
    fours[i + 2] = _mm256_unpacklo_epi64(pairs[i + 1], pairs[i + 3]);
    fours[i + 3] = _mm256_unpackhi_epi64(pairs[i + 1], pairs[i + 3]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + cell[i]),
                        _mm256_permute2x128_si256(fours[i], fours[i + 4], 0x20));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + cell[i + 4]),
                        _mm256_permute2x128_si256(fours[i], fours[i + 4], 0x31));
  }
}
#else
void transpose_8x8(const std::array<CellLanes, ImageTile::kColumns>& cells,
                   std::size_t firing,
                   std::size_t laser,
                   std::int32_t* to,
                   const std::int32_t* cell) noexcept {
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 8; ++k) to[cell[i] + static_cast<int>(k)] = cells[firing + k][laser + i];
}
#endif

}  // namespace

void ImageTile::write(std::int32_t* row_0, const std::array<std::int32_t, hdl64::kLasers>& cell) noexcept {
  const auto size = static_cast<std::size_t>(size_);
  const std::size_t in_eights = size / 8 * 8;
  std::int32_t* const to = row_0 + first_;
  for (std::size_t laser = 0; laser < hdl64::kLasers; laser += 8)
    for (std::size_t firing = 0; firing < in_eights; firing += 8)
      transpose_8x8(cells_, firing, laser, to + firing, cell.data() + laser);
  for (std::size_t firing = in_eights; firing < size; ++firing)
    for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser)
      to[cell[laser] + static_cast<std::int32_t>(firing)] = cells_[firing][laser];
  start(first_ + size_);
}

}  // namespace pago
