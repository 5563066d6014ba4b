// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pago/core/aligned_array.hpp"
#include "pago/core/sweep.hpp"
#include "spread.hpp"

namespace pago {

/// Gives returns their columns by azimuth and fills the range image. [set-up] the constructor allocates;
/// place() does not.
class ColumnPlacer {
 public:
  ColumnPlacer(std::size_t max_points, int max_columns);

  /// Needs sweep.size, header.num_columns and sweep.ring, and an empty range image; writes sweep.column and
  /// the range image. `turn` as in RingFinder. Returns how many returns found no cell.
  std::size_t place(Sweep& sweep, std::span<const float> turn) noexcept;

 private:
  /// Sorts by turn, equal ones by index: the bits of the turn (a float that is not negative orders like its
  /// bits), then the return's index.
  using Key = std::uint64_t;

  void sort_by_ring(const Sweep& sweep, std::span<const float> turn) noexcept;
  std::size_t place_ring(Sweep& sweep, int ring, std::span<const float> turn) noexcept;

  AlignedArray<Key> keys_;                               // of all returns, ring by ring
  std::array<std::size_t, kNumRings + 1> ring_begin_{};  // in keys_
  AlignedArray<float> positions_;                        // of one ring, in columns
  Spreader spreader_;
};

}  // namespace pago
