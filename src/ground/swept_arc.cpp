// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "swept_arc.hpp"

#include <algorithm>
#include <optional>

#include "atan2_turns.hpp"

namespace pago::ground {
namespace {

/// Azimuths of a column's returns; `first` is the one that the head met first.
struct ColumnAzimuth {
  float first_turns, last_turns;
};

std::optional<ColumnAzimuth> azimuth_of(const Sweep& sweep, const Coordinates& returns, int column) noexcept {
  std::optional<ColumnAzimuth> found;
  for (int ring = 0; ring < kNumRings; ++ring) {
    const std::int32_t cell = sweep.range_image.at(ring, column);
    if (cell < 0) continue;
    const auto i = static_cast<std::size_t>(cell);
    const float x = returns.x_m[i], y = returns.y_m[i];
    if (!(x * x + y * y > 1.0F)) continue;  // too near for an azimuth, or not finite
    const float azimuth = atan2_turns(y, x);
    if (!found) found = ColumnAzimuth{azimuth, azimuth};
    const float off = azimuth - found->first_turns;
    const float near = found->first_turns + (off - std::round(off));  // the same azimuth, not a turn away
    found->first_turns = std::max(found->first_turns, near);
    found->last_turns = std::min(found->last_turns, near);
  }
  return found;
}

}  // namespace

SweptArc swept_arc(const SweepPart& part, const Coordinates& returns) noexcept {
  constexpr float kMargin = 2.0F / 360.0F;
  const int end = static_cast<int>(part.columns_until);
  std::optional<ColumnAzimuth> start, stop;
  int from = kColumnMargin;
  for (; from < end && !start; ++from) start = azimuth_of(*part.sweep, returns, from);
  for (int column = end - 1; column >= from && !stop; --column)
    stop = azimuth_of(*part.sweep, returns, column);
  if (!start || !stop) return {};

  const float turned = start->last_turns - stop->first_turns;
  const float width = turned - std::floor(turned) - 2.0F * kMargin;
  return {start->last_turns - kMargin, std::max(0.0F, width)};
}

}  // namespace pago::ground
