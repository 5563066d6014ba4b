// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [vehicle] The box around the vehicle's own body, seen from `base_link` (on the ground below the sensor).
/// Returns inside are the vehicle's and no part of the world. All zero: no box.
struct VehicleConfig {
  double front_m = 0.0, rear_m = 0.0, left_m = 0.0, right_m = 0.0, top_m = 0.0;

  bool has_box() const noexcept { return front_m + rear_m > 0.0 && left_m + right_m > 0.0; }
};

template <typename Visitor>
void describe(Visitor& v, VehicleConfig& c) {
  v("front_m", c.front_m, within(-20.0, 50.0), "the vehicle's body reaches so far ahead of base_link");
  v("rear_m", c.rear_m, within(-20.0, 50.0), "and so far behind it");
  v("left_m", c.left_m, within(-20.0, 20.0), "to the left");
  v("right_m", c.right_m, within(-20.0, 20.0), "to the right");
  v("top_m", c.top_m, within(0.0, 20.0), "and so high above the ground; everything below counts too");
}

}  // namespace pago
