// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "pago/config/ground/linefit.hpp"
#include "pago/core/aligned_array.hpp"

namespace pago::ground {

/// A return as a segment's lines see it: horizontal range and height.
struct RangeHeight {
  float range_m = 0.0F, z_m = 0.0F;
};

/// A piece of ground in a segment: z = slope * range + base.
struct GroundLine {
  float slope = 0.0F, base_m = 0.0F;
  float from_m = 0.0F, until_m = 0.0F;  ///< ranges where it holds, with its reach beyond its ends

  bool holds(float range_m) const noexcept { return (from_m < range_m) & (range_m < until_m); }
  float height_at(float range_m) const noexcept { return slope * range_m + base_m; }
  float above(const RangeHeight& p) const noexcept { return p.z_m - height_at(p.range_m); }
};

/// Lines at most that `points` returns can make.
constexpr std::size_t max_lines(std::size_t points) {
  return points / 2 + 1;
}

/// Himmelsbach's incremental line extraction over a segment's lowest returns, nearest first: the lines go on
/// while they fit. `ground_z_m` is where the first line is expected to begin. Writes to `lines` (room for
/// max_lines(points.size())) and returns how many there are. Real-time safe.
std::size_t extract_lines(std::span<const RangeHeight> points,
                          double ground_z_m,
                          const LinefitConfig& config,
                          std::span<GroundLine> lines) noexcept;

}  // namespace pago::ground
