// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/ground.hpp"
#include "pago/config/hdl64.hpp"
#include "pago/config/mount.hpp"

namespace pago {

/// Every setting of PaGO, by module. A default-constructed Config is a working one; change fields directly,
/// or from files and `key=value` words (config/load.hpp). Plain data: copy freely.
struct Config {
  Mount mount;
  Hdl64Config hdl64;
  GroundConfig ground;
};

template <typename Visitor>
void describe(Visitor& v, Config& c) {
  v.section("mount", c.mount, "how the sensor sits on the vehicle");
  v.section("hdl64", c.hdl64, "the sensor: its calibration, and how its packets are read");
  v.section("ground", c.ground, "which returns the vehicle could stand on");
}

}  // namespace pago
