// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ring_chains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atan2_turns.hpp"

namespace pago::ground {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// How far apart two beams, `low` and `high` degrees below the horizon, hit ground that rises by `slope`.
double spacing(double height_m, double low_deg, double high_deg, double slope_deg) {
  const auto range = [&](double deg) {
    return 1.0 / (std::tan(deg * kRadPerDeg) + std::tan(slope_deg * kRadPerDeg));
  };
  return height_m * std::abs(range(high_deg) - range(low_deg));
}

}  // namespace

RingChains::RingChains(const CascadedConfig& config, std::uint32_t max_returns)
    : config_(config), cell_of_(max_returns), image_(kRows * kColumns + 1) {}

void RingChains::set_height(double height_m) noexcept {
  double sum_m = 0.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    reach_m_[row] = static_cast<float>(sum_m);
    const int from_top = static_cast<int>(kRows - 1 - row);
    if (from_top == 0) break;
    sum_m += spacing(height_m, beam_below_horizon_deg(from_top), beam_below_horizon_deg(from_top - 1),
                     config_.max_slope_deg);
  }
}

/// Row: the beam by its angle, in steps of a third of a degree down to -8.83 and of a half below; cut towards
/// zero as in the authors' code.
void RingChains::project(const Coordinates& returns, std::uint32_t size) noexcept {
  const auto near = static_cast<float>(config_.min_range_m), far = static_cast<float>(config_.max_range_m);
  constexpr auto kOutside = static_cast<std::uint32_t>(kRows * kColumns);
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
    const auto column = static_cast<std::int32_t>((turns < 0.0F ? turns + 1.0F : turns) * kColumns);
    const std::int32_t wrapped = column < static_cast<std::int32_t>(kColumns) ? column : 0;
    const std::int32_t cell = wrapped * static_cast<std::int32_t>(kRows) + (63 - beam);
    cell_of[i] = is_inside ? static_cast<std::uint32_t>(cell) : kOutside;
  }
}

void RingChains::find_candidates(const Coordinates& returns,
                                 std::uint32_t size,
                                 std::uint8_t* is_candidate) noexcept {
  project(returns, size);
  constexpr std::size_t kOutside = kRows * kColumns;
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
  const auto max_upright = static_cast<float>(config_.max_upright_m);
  std::size_t first = 0, last = kRows;  // rows of the chain; last = kRows: none yet
  float range = 0.0F, lowest = 0.0F, highest = 0.0F;
  const auto judge = [&] {
    if (last == kRows || !(highest - lowest > max_upright)) return;
    for (std::size_t row = first; row <= last; ++row)
      if (cells[row] >= 0) is_candidate[cells[row]] = 0;
  };
  for (std::size_t row = 0; row < kRows; ++row) {
    if (cells[row] < 0) continue;
    const auto i = static_cast<std::size_t>(cells[row]);
    const float x = returns.x_m[i], y = returns.y_m[i], z = returns.z_m[i];
    const float here = std::sqrt(x * x + y * y);
    if (last < kRows && std::fabs(range - here) < reach_m_[row] - reach_m_[last]) {
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
