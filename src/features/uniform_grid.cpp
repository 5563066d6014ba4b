// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "pago/core/units.hpp"
#include "pago/features/feature_image.hpp"

namespace pago::features {

UniformGrid::UniformGrid(const UniformGridConfig& config, double min_range_m, std::uint32_t max_returns)
    : config_(config), min_range_m_(static_cast<float>(min_range_m)), ground_(max_returns) {}

FeatureImage UniformGrid::project(const Sweep& sweep) noexcept {
  const auto degrees = [](float radians) { return radians / static_cast<float>(kDegree); };
  const auto row_step = static_cast<float>(config_.row_step_deg),
             bottom = static_cast<float>(config_.bottom_deg);
  const float column_step = 360.0F / static_cast<float>(config_.columns);
  std::copy_n(sweep.ground.begin(), sweep.size, ground_.begin());
  cells_.clear(config_.columns);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
    const float range_m = std::sqrt(x * x + y * y + z * z);
    if (!(range_m >= min_range_m_) || !std::isfinite(range_m)) continue;
    const float row = (degrees(std::atan2(z, std::sqrt(x * x + y * y))) + bottom) / row_step;
    if (!(row > -1.0F && row < static_cast<float>(kNumRings))) continue;
    const long right = std::lround(degrees(std::atan2(-y, x)) / column_step);
    const int column = (static_cast<int>(right) + config_.columns / 2 + config_.columns) % config_.columns;
    std::int32_t& cell = cells_.at(static_cast<int>(row), column);
    if (cell != RangeImage::kEmpty && ground_[static_cast<std::uint32_t>(cell)] == kGround)
      ground_[i] = kGround;
    cell = static_cast<std::int32_t>(i);
  }
  return {cells_, config_.columns, ground_.first(sweep.size),
          static_cast<float>(config_.row_step_deg * kDegree), static_cast<float>(kDegree) * column_step};
}

}  // namespace pago::features
