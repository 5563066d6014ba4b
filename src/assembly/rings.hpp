// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "pago/assembly/scan_organizer.hpp"
#include "spread.hpp"

namespace pago {

/// `turn` of points that are no returns.
inline constexpr float kNoTurn = -1.0F;

/// The ring, with fraction, at which KITTI's HDL-64E looks at a point (metres, sensor frame); [0, 63].
float ring_by_elevation(float x_m, float y_m, float z_m) noexcept;

/// Finds rings. [set-up] the constructor allocates; assign() does not.
class RingFinder {
 public:
  RingFinder() : spreader_(kNumRings) {}

  /// Writes sweep.ring for all its points. `turn`: how far the head had turned from the rear, clockwise, in
  /// revolutions [0, 1], or kNoTurn.
  RingSource assign(Sweep& sweep, std::span<const float> turn) noexcept;

 private:
  bool assign_segments(Sweep& sweep, std::span<const float> turn, int num_segments) noexcept;
  Spreader spreader_;
};

}  // namespace pago
