// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "pago/config/config.hpp"

namespace pago::simulator {

/// Takes the name of a simulated drive, what follows "sim:" in a source: a world, and settings of [simulator]
/// that differ from `config`, as in "urban,seed=3,seconds=60". They are checked as `--set simulator.seed=3`
/// is; throws Error. [any thread]
void apply_drive_name(Config& config, std::string_view name);

}  // namespace pago::simulator
