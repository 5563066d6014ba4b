// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace pago::ground {

/// Coordinates side by side in memory, z up. Those of a bin or of a whole sweep.
struct Points {
  std::span<const float> x_m, y_m, z_m;

  std::size_t size() const noexcept { return z_m.size(); }
  Points from(std::size_t begin, std::size_t count) const noexcept {
    return {x_m.subspan(begin, count), y_m.subspan(begin, count), z_m.subspan(begin, count)};
  }
};

/// Whether these are the coordinates of a return: finite and not all zero.
inline bool is_return(float x_m, float y_m, float z_m) noexcept {
  const float range_sq = x_m * x_m + y_m * y_m + z_m * z_m;
  return (range_sq > 0.0F) & (range_sq <= std::numeric_limits<float>::max());  // false for NaN
}

}  // namespace pago::ground
