// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ring_chains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atan2_turns.hpp"
#include "pago/core/units.hpp"

namespace pago::ground {
namespace {

/// How far apart two beams, `low` and `high` degrees below the horizon, hit ground that rises by `slope`.
double spacing(double height_m, double low_deg, double high_deg, double slope_deg) {
  const auto range = [&](double deg) {
    return 1.0 / (std::tan(deg * kDegree) + std::tan(slope_deg * kDegree));
  };
  return height_m * std::abs(range(high_deg) - range(low_deg));
}

/// How far from a whole number.
float to_whole(float number) {
  return std::fabs(number - std::nearbyint(number));
}

}  // namespace

RingChains::RingChains(const CascadedConfig& config, std::uint32_t max_returns)
    : config_(config), cell_of_(max_returns), image_(kRows * kColumns + 1) {}

void RingChains::set_height(double height_m) noexcept {
  double sum_m = 0.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    reach_m_[row] = sum_m;
    const int from_top = static_cast<int>(kRows - 1 - row);
    if (from_top == 0) break;
    sum_m += spacing(height_m, beam_below_horizon_deg(from_top), beam_below_horizon_deg(from_top - 1),
                     config_.max_slope_deg);
  }
}

/// Row: the beam by its angle, in steps of a third of a degree down to -8.83 and of a half below; cut towards
/// zero as in the authors' code. Single precision leaves returns that lie on a bound to be placed exactly:
/// one return more in a region would give it other random samples, and so another plane.
void RingChains::project(const Coordinates& returns, std::uint32_t size) noexcept {
  const auto near = static_cast<float>(config_.min_range_m), far = static_cast<float>(config_.max_range_m);
  std::uint32_t* const cell_of = cell_of_.data();
#pragma omp simd
  for (std::uint32_t i = 0; i < size; ++i) {
    const float x = returns.x_m[i], y = returns.y_m[i], z = returns.z_m[i];
    const float range = std::sqrt(x * x + y * y);
    const float angle_deg = 360.0F * atan2_turns(z, range);
    const bool is_upper = angle_deg >= -8.83F;
    const float from_top = is_upper ? (2.0F - angle_deg) * 3.0F + 0.5F : 32.5F + (-8.83F - angle_deg) * 2.0F;
    const bool is_inside = (range > near) & (range < far) & (from_top > -1.0F) & (from_top < 64.0F);
    const auto beam = static_cast<std::int32_t>(is_inside ? from_top : 0.0F);
    const float turns = atan2_turns(y, x);
    const float along = (turns < 0.0F ? turns + 1.0F : turns) * kColumns;
    const auto column = static_cast<std::int32_t>(along);
    const std::int32_t wrapped = column < static_cast<std::int32_t>(kColumns) ? column : 0;
    const std::int32_t cell = wrapped * static_cast<std::int32_t>(kRows) + (63 - beam);
    // Ten times what the arctangents (3e-7 rad) and rounding can be off.
    constexpr float kUnclear = 2e-3F, kUnclear_m = 1e-4F;
    const bool is_unclear = (to_whole(from_top) < kUnclear) | (to_whole(along) < kUnclear) |
                            (std::fabs(range - near) < kUnclear_m) | (std::fabs(range - far) < kUnclear_m);
    const std::uint32_t clear = is_inside ? static_cast<std::uint32_t>(cell) : kOutside;
    cell_of[i] = is_unclear ? kUnclearCell : clear;
  }
  for (std::uint32_t i = 0; i < size; ++i)
    if (cell_of[i] == kUnclearCell) cell_of[i] = exact_cell(returns, i);
}

std::uint32_t RingChains::exact_cell(const Coordinates& returns, std::uint32_t i) const noexcept {
  const auto x_m = static_cast<double>(returns.x_m[i]), y_m = static_cast<double>(returns.y_m[i]),
             z_m = static_cast<double>(returns.z_m[i]);
  const double range_m = std::hypot(x_m, y_m);
  const double angle_deg = std::atan2(z_m, range_m) / kDegree;
  const double from_top =
      angle_deg >= -8.83 ? (2.0 - angle_deg) * 3.0 + 0.5 : 32.5 + (-8.83 - angle_deg) * 2.0;
  const bool is_inside = range_m > config_.min_range_m && range_m < config_.max_range_m && from_top > -1.0 &&
                         from_top < static_cast<double>(kRows);
  if (!is_inside) return kOutside;
  const double turns = std::atan2(y_m, x_m) / (2.0 * std::numbers::pi);
  const auto column = static_cast<std::uint32_t>((turns < 0.0 ? turns + 1.0 : turns) * kColumns);
  const auto beam = static_cast<std::uint32_t>(std::max(0.0, from_top));
  return static_cast<std::uint32_t>(column % kColumns * kRows + (kRows - 1 - beam));
}

void RingChains::find_candidates(const Coordinates& returns,
                                 std::uint32_t size,
                                 std::uint8_t* is_candidate) noexcept {
  project(returns, size);
  std::fill(image_.begin(), image_.end(), RangeImage::kEmpty);
  for (std::uint32_t i = 0; i < size; ++i) {
    image_[cell_of_[i]] = static_cast<std::int32_t>(i);
    is_candidate[i] = cell_of_[i] == kOutside ? 0 : 1;
  }
  for (std::size_t column = 0; column < kColumns; ++column)
    follow_column(returns, image_.data() + column * kRows, is_candidate);
}

void RingChains::follow_column(const Coordinates& returns,
                               const std::int32_t* cells,
                               std::uint8_t* is_candidate) const noexcept {
  std::size_t first = 0, last = kRows;  // rows of the chain; last = kRows: none yet
  double range = 0.0, lowest = 0.0, highest = 0.0;
  const auto judge = [&] {
    if (last == kRows || !(highest - lowest > config_.max_upright_m)) return;
    for (std::size_t row = first; row <= last; ++row)
      if (cells[row] >= 0) is_candidate[cells[row]] = 0;
  };
  for (std::size_t row = 0; row < kRows; ++row) {
    if (cells[row] < 0) continue;
    const auto i = static_cast<std::size_t>(cells[row]);
    const auto x = static_cast<double>(returns.x_m[i]), y = static_cast<double>(returns.y_m[i]),
               z = static_cast<double>(returns.z_m[i]);
    const double here = std::sqrt(x * x + y * y);
    if (last < kRows && std::abs(range - here) < reach_m_[row] - reach_m_[last]) {
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    } else {
      judge();
      first = row;
      lowest = highest = z;
    }
    last = row;
    range = here;
  }
  judge();
}

}  // namespace pago::ground
