// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "level.hpp"
#include "pago/config/ground/cascaded.hpp"

namespace pago::ground {

/// How far the k-th beam from the top looks below the horizon (HDL-64E, as CascadedSeg has it).
constexpr double beam_below_horizon_deg(int from_top) {
  return from_top < 32 ? from_top / 3.0 - 2.0 : 8.83 + (from_top - 32) / 2.0;
}

/// First stage of CascadedSeg: in each column of a grid of beams, from the lowest up, returns are chained
/// while they are nearer to each other than two rings on the steepest ground would be; a chain that reaches
/// over much height is an obstacle. [front thread] everything but the constructor; real-time safe.
class RingChains {
 public:
  /// [set-up] Allocates.
  RingChains(const CascadedConfig& config, std::uint32_t max_returns);

  /// Ring spacings go with the height of the sensor.
  void set_height(double height_m) noexcept;

  /// Writes for each of `size` returns 1 where it may be ground: within range, on one of the HDL-64E's beams,
  /// and in no chain that is an obstacle. Of the returns in a cell of the grid the last one is judged; the
  /// others are not.
  void find_candidates(const Coordinates& returns, std::uint32_t size, std::uint8_t* is_candidate) noexcept;

 private:
  static constexpr std::size_t kRows = 64, kColumns = 2083;  // as in the authors' code
  static constexpr std::uint32_t kOutside = kRows * kColumns, kUnclearCell = kOutside + 1;

  void project(const Coordinates& returns, std::uint32_t size) noexcept;
  std::uint32_t exact_cell(const Coordinates& returns, std::uint32_t i) const noexcept;
  void follow_column(const Coordinates& returns,
                     const std::int32_t* cells,
                     std::uint8_t* is_candidate) const noexcept;

  CascadedConfig config_;
  std::array<double, kRows> reach_m_{};  // [row]: sum of the spacings of all rows below it
  AlignedArray<std::uint32_t> cell_of_;  // per return
  AlignedArray<std::int32_t> image_;     // column by column; one more cell: returns outside
};

}  // namespace pago::ground
