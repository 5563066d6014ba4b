// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "firing_lanes.hpp"
#include "pago/core/prefetch.hpp"

namespace pago {

/// The newest columns of a range image, kept firing by firing before they go into its rows. A firing's cells
/// lie in 64 rows, so in 64 pages: written one by one they miss the processor's address translation and
/// cannot be stored as vectors. Sixteen firings at a time, transposed, they can (measured:
/// docs/decisions.md).
class ImageTile {
 public:
  static constexpr int kColumns = 16;

  /// The tile's next firing, in column `column` (of a laser without shift).
  bool takes(int column) const noexcept { return size_ < kColumns && column == first_ + size_; }
  /// Begins anew at a column. The old content must have been written or is given up.
  void start(int column) noexcept {
    first_ = column;
    size_ = 0;
  }
  /// Cells of the next firing, to be filled by the caller.
  CellLanes& next() noexcept { return cells_[static_cast<std::size_t>(size_++)]; }
  /// The column behind the tile's last firing.
  int end() const noexcept { return first_ + size_; }

  /// Asks for some of the rows' cache lines that write() will need, a sixteenth of them: to be called for
  /// each firing. Sixty-four rows are more than a processor foresees by itself.
  void prefetch(const std::int32_t* row_0,
                const std::array<std::int32_t, hdl64::kLasers>& cell) const noexcept {
    constexpr int kEach = hdl64::kLasers / kColumns;
    for (int laser = kEach * size_; laser < kEach * (size_ + 1); ++laser)
      prefetch_to_write(row_0 + cell[static_cast<std::size_t>(laser)] + first_ + kColumns - 1);
  }

  /// Writes what there is into the rows; `cell[laser]` is where a laser's column 0 lies after `row_0`.
  void write(std::int32_t* row_0, const std::array<std::int32_t, hdl64::kLasers>& cell) noexcept;

 private:
  alignas(64) std::array<CellLanes, kColumns> cells_{};
  int first_ = 0, size_ = 0;
};

}  // namespace pago
