// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "pago/config/features.hpp"
#include "pago/core/sweep.hpp"

namespace pago::features {

/// What clusters and features are found in: cells, and for each return whether its cell is ground.
struct FeatureImage {
  const RangeImage& cells;
  int columns;
  std::span<const std::uint8_t> ground;
  /// Angles between neighbouring cells; 0: to be told from the returns themselves.
  float row_step_rad = 0.0F, column_step_rad = 0.0F;
};

/// The sweep's own range image and mask: features.projection = ring.
inline FeatureImage own_image(const Sweep& sweep) noexcept {
  return {sweep.range_image, static_cast<int>(sweep.header.num_columns), sweep.ground.first(sweep.size)};
}

/// LeGO-LOAM's grid of equal angles (its projectPointCloud): features.projection = uniform. Row: elevation
/// from the bottom, cut towards zero; column: azimuth, rounded, the x axis in the middle. Of a pixel's
/// returns the last one stays, and the pixel is ground if any of them is (PaGO-LOAM). Returns outside, and
/// closer ones, have no pixel. [set-up] constructor; [front thread] project(): real-time safe, deterministic.
class UniformGrid {
 public:
  UniformGrid(const UniformGridConfig& config, double min_range_m, std::uint32_t max_returns);

  /// Valid until the next call.
  FeatureImage project(const Sweep& sweep) noexcept;

 private:
  UniformGridConfig config_;
  float min_range_m_;
  RangeImage cells_;
  AlignedArray<std::uint8_t> ground_;
};

}  // namespace pago::features
