// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ground.hpp"
#include "pago/config/simulator.hpp"
#include "road.hpp"
#include "scenery.hpp"
#include "traffic.hpp"
#include "vehicle.hpp"

namespace pago::simulator {

/// What makes a world what it is.
struct Preset {
  GroundStyle ground;
  Scenery scenery;
  TrafficStyle traffic;
  Pace pace;
  bool has_uneven_streets = false;  ///< as KITTI's are within a metre or two (materials.hpp: relief_m)
  RoadShape road;  ///< of a drive that is made up; in `urban` only the width matters, along a path
};

Preset preset_of(SimulatedWorld world);

}  // namespace pago::simulator
