// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/core/aligned_array.hpp"

namespace pago {

inline constexpr int kNumRings = 64;
/// A revolution at 5 Hz has 4,167 firings (48 us each), an S1's 4,680; a little slower is still whole.
inline constexpr int kMaxColumns = 4736;
/// Room on either side of a row for lasers that look ahead of or behind the encoder: |rotCorrection| up to 15
/// degrees at 5 Hz is 174 columns.
inline constexpr int kColumnMargin = 192;

/// ring x column -> index of the return in the sweep's arrays, or kEmpty. Ring 0 is the lowest, columns
/// follow the head's rotation (clockwise seen from above), one column per firing.
///
/// A row is `margin | columns | margin | pad`. While a sweep is filled, a laser's column may run into a
/// margin; closing the sweep folds it in (assembly/assembler.hpp). The pad of one cache line makes the row
/// stride an odd number of lines, so that a column's 64 cells do not share a few cache sets (measured: 3 x on
/// filling).
class RangeImage {
 public:
  static constexpr std::int32_t kEmpty = -1;
  static constexpr int kRowStride = 2 * kColumnMargin + kMaxColumns + 16;

  /// [set-up] allocates.
  RangeImage() : cells_(static_cast<std::size_t>(kNumRings) * kRowStride, kEmpty) {}

  /// Column in [-kColumnMargin, kMaxColumns + kColumnMargin).
  std::int32_t& at(int ring, int column) noexcept { return cells_[offset(ring, column)]; }
  std::int32_t at(int ring, int column) const noexcept { return cells_[offset(ring, column)]; }

  /// The row's first true column; valid to index from -kColumnMargin on.
  std::int32_t* row(int ring) noexcept { return cells_.data() + offset(ring, 0); }
  const std::int32_t* row(int ring) const noexcept { return cells_.data() + offset(ring, 0); }

  /// Empties columns [-kColumnMargin, columns + kColumnMargin) of every ring.
  void clear(int columns) noexcept {
    const std::size_t n = static_cast<std::size_t>(columns + 2 * kColumnMargin);
    for (int ring = 0; ring < kNumRings; ++ring) std::fill_n(row(ring) - kColumnMargin, n, kEmpty);
  }
  /// Empties columns [begin, end) of a ring; none if begin >= end.
  void clear(int ring, int begin, int end) noexcept {
    if (begin < end) std::fill_n(row(ring) + begin, end - begin, kEmpty);
  }

 private:
  static std::size_t offset(int ring, int column) noexcept {
    return static_cast<std::size_t>(ring * kRowStride + kColumnMargin + column);
  }
  AlignedArray<std::int32_t> cells_;
};

static_assert((RangeImage::kRowStride * static_cast<int>(sizeof(std::int32_t)) / 64) % 2 == 1);

}  // namespace pago
