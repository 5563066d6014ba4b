// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.mount_check] Whether the ground lies where [mount] says, looked at once in the first sweeps.
struct MountCheckConfig {
  bool enabled = true;
  int sweeps = 10;
  double max_range_m = 20.0;
  double max_height_error_m = 0.25;
  double max_tilt_error_deg = 5.0;
};

template <typename Visitor>
void describe(Visitor& v, MountCheckConfig& c) {
  v("enabled", c.enabled, "whether the first sweeps are looked at");
  v("sweeps", c.sweeps, within(1, 100), "how many whole sweeps the verdict is made of");
  v("max_range_m", c.max_range_m, within(5.0, 100.0), "farther returns are not looked at: roads bend");
  v("max_height_error_m", c.max_height_error_m, within(0.01, 10.0),
    "a height that differs more from mount.height_m is reported");
  v("max_tilt_error_deg", c.max_tilt_error_deg, within(0.1, 90.0),
    "a ground that is tilted more against the mount is reported");
}

/// [ground.height] Estimation of the sensor's height from the first sweep, instead of mount.height_m:
/// all-terrain automatic sensor-height estimation (ATAT) of the Patchwork authors' ROS 2 code.
struct HeightEstimateConfig {
  bool enabled = false;
  double max_range_m = 5.0;
  int sectors = 20;
  double max_linearity = 0.9;
  double noise_bound_m = 0.2;
  double max_change_m = 1.0;
};

template <typename Visitor>
void describe(Visitor& v, HeightEstimateConfig& c) {
  v("enabled", c.enabled,
    "whether the height is taken from the first whole sweep in which it can be seen; false: mount.height_m "
    "holds");
  v("max_range_m", c.max_range_m, within(3.0, 50.0),
    "horizontal; looked at are returns up to this range, up to twice and four times as far if that shows no "
    "ground "
    "(code: 5)");
  v("sectors", c.sectors, within(4, 360), "a plane each is fitted in so many sectors (code: 20)");
  v("max_linearity", c.max_linearity, within(0.0, 1.0),
    "planes whose returns lie on a line more than this are left out (code: 0.9)");
  v("noise_bound_m", c.noise_bound_m, within(0.001, 5.0),
    "planes agree on a height within this, the more loosely the more linear they are (code: 0.2)");
  v("max_change_m", c.max_change_m, within(0.0, 10.0),
    "an estimate that differs more from mount.height_m is not taken: of a sensor upside down it is of "
    "something else than the ground (code: no bound)");
}

}  // namespace pago
