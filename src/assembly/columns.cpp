// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "columns.hpp"

#include <algorithm>
#include <bit>

#include "rings.hpp"

namespace pago {

ColumnPlacer::ColumnPlacer(std::size_t max_points, int max_columns)
    : keys_(max_points),
      positions_(static_cast<std::size_t>(max_columns)),
      spreader_(static_cast<std::size_t>(max_columns)) {}

std::size_t ColumnPlacer::place(Sweep& sweep, std::span<const float> turn) noexcept {
  const auto num_columns = static_cast<int>(sweep.header.num_columns);
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const int column = static_cast<int>(std::max(0.0F, turn[i]) * static_cast<float>(num_columns));
    sweep.column[i] = static_cast<std::uint16_t>(std::min(column, num_columns - 1));
  }
  sort_by_ring(sweep, turn);
  std::size_t homeless = 0;
  for (int ring = 0; ring < kNumRings; ++ring) homeless += place_ring(sweep, ring, turn);
  return homeless;
}

void ColumnPlacer::sort_by_ring(const Sweep& sweep, std::span<const float> turn) noexcept {
  std::array<std::size_t, kNumRings> count{};
  for (std::size_t i = 0; i < turn.size(); ++i) count[sweep.ring[i]] += turn[i] == kNoTurn ? 0U : 1U;
  for (std::size_t r = 0; r < kNumRings; ++r) ring_begin_[r + 1] = ring_begin_[r] + count[r];
  std::array<std::size_t, kNumRings> next{};
  std::copy_n(ring_begin_.begin(), kNumRings, next.begin());
  for (std::size_t i = 0; i < turn.size(); ++i)
    if (turn[i] != kNoTurn)
      keys_[next[sweep.ring[i]]++] = Key{std::bit_cast<std::uint32_t>(turn[i])} << 32 | i;
  for (std::size_t r = 0; r < kNumRings; ++r)
    std::sort(keys_.begin() + ring_begin_[r], keys_.begin() + ring_begin_[r + 1]);
}

std::size_t ColumnPlacer::place_ring(Sweep& sweep, int ring, std::span<const float> turn) noexcept {
  const auto r = static_cast<std::size_t>(ring);
  const auto num_columns = static_cast<int>(sweep.header.num_columns);
  const std::size_t size = ring_begin_[r + 1] - ring_begin_[r];
  // An overfull ring (no HDL-64E) gives up returns evenly.
  const std::size_t kept = std::min<std::size_t>(size, sweep.header.num_columns);
  const auto chosen = [&](std::size_t k) {
    return static_cast<std::uint32_t>(keys_[ring_begin_[r] + k * size / kept]);
  };
  for (std::size_t k = 0; k < kept; ++k) positions_[k] = turn[chosen(k)] * static_cast<float>(num_columns);
  const std::span<const int> cells = spreader_.spread(positions_.first(kept), num_columns);
  for (std::size_t k = 0; k < kept; ++k) {
    sweep.column[chosen(k)] = static_cast<std::uint16_t>(cells[k]);
    sweep.range_image.at(ring, cells[k]) = static_cast<std::int32_t>(chosen(k));
  }
  return size - kept;
}

}  // namespace pago
