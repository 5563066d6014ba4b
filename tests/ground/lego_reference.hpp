// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "pago/config/ground.hpp"
#include "pago/core/sweep.hpp"

/// LeGO-LOAM's ground removal with its projection, as its code has it: column by column, with arctangents.
namespace pago::test {

inline double degrees(double y, double x) {
  return std::atan2(y, x) * 180.0 / std::numbers::pi;
}

/// Pixel of a return, or -1.
inline int lego_pixel(double x, double y, double z, const LegoConfig& c) {
  if (!(std::sqrt(x * x + y * y + z * z) >= c.min_range_m)) return -1;
  const double row = (degrees(z, std::hypot(x, y)) + c.uniform_bottom_deg) / c.uniform_row_step_deg;
  if (!(row > -1.0 && row < c.uniform_rows)) return -1;
  const double column_step_deg = 360.0 / c.uniform_columns;
  long column = -std::lround((degrees(x, y) - 90.0) / column_step_deg) + c.uniform_columns / 2;
  if (column >= c.uniform_columns) column -= c.uniform_columns;
  return static_cast<int>(row) * c.uniform_columns + static_cast<int>(column);
}

inline std::vector<std::uint8_t> lego_reference(const Sweep& sweep, const LegoConfig& c) {
  const int rows = c.uniform_rows, columns = c.uniform_columns;
  std::vector<int> pixel(sweep.size), holder(static_cast<std::size_t>(rows * columns), -1);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    pixel[i] = lego_pixel(static_cast<double>(sweep.x_m[i]), static_cast<double>(sweep.y_m[i]),
                          static_cast<double>(sweep.z_m[i]), c);
    if (pixel[i] >= 0) holder[static_cast<std::size_t>(pixel[i])] = static_cast<int>(i);
  }
  std::vector<int> ground(holder.size(), 0);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < c.ground_rings; ++row) {
      const auto low = static_cast<std::size_t>(row * columns + column);
      const auto high = low + static_cast<std::size_t>(columns);
      if (holder[low] < 0 || holder[high] < 0) {
        ground[low] = -1;
        continue;
      }
      const auto a = static_cast<std::size_t>(holder[low]), b = static_cast<std::size_t>(holder[high]);
      const double dx = static_cast<double>(sweep.x_m[b]) - static_cast<double>(sweep.x_m[a]);
      const double dy = static_cast<double>(sweep.y_m[b]) - static_cast<double>(sweep.y_m[a]);
      const double dz = static_cast<double>(sweep.z_m[b]) - static_cast<double>(sweep.z_m[a]);
      if (std::abs(degrees(dz, std::hypot(dx, dy))) <= c.max_slope_deg) ground[low] = ground[high] = 1;
    }
  }
  std::vector<std::uint8_t> mask(sweep.size, kNonGround);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    if (pixel[i] >= 0 && ground[static_cast<std::size_t>(pixel[i])] == 1) mask[i] = kGround;
  return mask;
}

}  // namespace pago::test
