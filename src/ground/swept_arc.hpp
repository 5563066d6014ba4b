// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "level.hpp"
#include "pago/core/stage.hpp"

namespace pago::ground {

/// A stretch of azimuth, clockwise as the head turns. Azimuths are in turns, from the x axis to the left.
struct SweptArc {
  float start_turns = 0.0F;
  float width_turns = 0.0F;

  /// Whether it holds all of [right, left], where left - right < 1.
  bool holds(float right_turns, float left_turns) const noexcept {
    const float ahead = start_turns - left_turns;
    return ahead - std::floor(ahead) + (left_turns - right_turns) <= width_turns;
  }
};

/// Where no more returns of a sweep are to be expected once its columns [kColumnMargin, part.columns_until)
/// are closed. An expectation, not a promise: lasers sit a few centimetres beside the axis, and a tilted
/// mount bends columns; two degrees at both ends are kept free for that. Nothing (width 0) before a column is
/// closed.
SweptArc swept_arc(const SweepPart& part, const Coordinates& returns) noexcept;

}  // namespace pago::ground
