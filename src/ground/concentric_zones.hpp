// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "polar_bins.hpp"

namespace pago::ground {

/// The concentric zone model of Patchwork (Sec. III-B): four zones that end at (7 near + far) / 8,
/// (3 near + far) / 4, (near + far) / 2 and far. [set-up] Throws Error, which names the settings in
/// `section`, unless near < far and all numbers of rings and sectors are whole.
PolarGrid concentric_zones(const std::string& section,
                           double near_m,
                           double far_m,
                           const std::array<double, 4>& rings,
                           const std::array<double, 4>& sectors);

}  // namespace pago::ground
