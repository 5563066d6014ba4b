// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "column_test.hpp"

#include <limits>

namespace pago::ground {

void load_row(const Coordinates& returns,
              const std::int32_t* cells,
              int width,
              float min_range_sq_m2,
              StripRow& row) noexcept {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr float kMaxFinite = std::numeric_limits<float>::max();
  for (int k = 0; k < width; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const bool is_empty = cells[k] < 0;
    const std::size_t i = is_empty ? 0 : static_cast<std::size_t>(cells[k]);
    row.x_m[c] = is_empty ? kNone : returns.x_m[i];
    row.y_m[c] = returns.y_m[i];
    row.z_m[c] = returns.z_m[i];
  }
  for (std::size_t c = 0; c < kStripColumns; ++c) {
    const float range_sq = row.x_m[c] * row.x_m[c] + row.y_m[c] * row.y_m[c] + row.z_m[c] * row.z_m[c];
    const bool is_usable = (range_sq >= min_range_sq_m2) & (range_sq <= kMaxFinite);  // not NaN either
    row.x_m[c] = is_usable ? row.x_m[c] : kNone;
  }
}

void compare_rows(const ColumnTest& test,
                  const StripRow& lower,
                  const StripRow& upper,
                  StripVerdict& upper_is_level,
                  StripVerdict& lower_is_ground) noexcept {
  for (std::size_t c = 0; c < kStripColumns; ++c) {
    const float dx = upper.x_m[c] - lower.x_m[c];
    const float dy = upper.y_m[c] - lower.y_m[c];
    const float dz = upper.z_m[c] - lower.z_m[c];
    const bool is_missing = dx != dx;
    const bool is_level = dz * dz <= test.max_slope_sq * (dx * dx + dy * dy);  // false for NaN
    const bool was_level = upper_is_level[c] != 0;
    const bool kept = was_level & !(is_missing & test.missing_undoes);
    lower_is_ground[c] = (is_level | kept) ? 1 : 0;
    upper_is_level[c] = is_level ? 1 : 0;
  }
}

}  // namespace pago::ground
