// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/config/simulator.hpp"
#include "pago/simulator/trajectory.hpp"
#include "traffic.hpp"
#include "world.hpp"

namespace pago::simulator {

/// A world, and a drive through it.
struct Surroundings {
  std::unique_ptr<World> world;
  std::unique_ptr<Traffic> traffic;
  std::unique_ptr<Trajectory> T_world_base;
};

/// [set-up] Lays out what the settings ask for. Throws Error for a path file that cannot be driven along.
Surroundings lay_out(const SimulatorConfig& config);

}  // namespace pago::simulator
