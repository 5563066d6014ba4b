// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"
#include "pago/core/mount.hpp"

namespace pago {

/// [mount]
template <typename Visitor>
void describe(Visitor& v, Mount& m) {
  constexpr double kHalfTurn = 3.1416;  // a little more than pi: an inverted sensor may be written so
  v("height_m", m.height_m, within(0.1, 10.0), "of the sensor's origin above the ground");
  v("roll_rad", m.roll_rad, within(-kHalfTurn, kHalfTurn),
    "turn about the vehicle's x axis (forward); positive: left side up");
  v("pitch_rad", m.pitch_rad, within(-kHalfTurn, kHalfTurn),
    "turn about the vehicle's y axis (left); positive: nose down");
  v("yaw_rad", m.yaw_rad, within(-kHalfTurn, kHalfTurn),
    "turn about the vehicle's z axis (up); positive: to the left");
}

}  // namespace pago
