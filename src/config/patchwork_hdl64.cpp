// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/ground/patchwork.hpp"

namespace pago {

/// What perf/patchwork_search.cpp ends with (docs/ground.md). The rings are narrower than the paper's: all
/// four bounds on elevation lie in the innermost zone. No flat plane above them is ground: in bins so small a
/// roof is alone, and flat.
PatchworkConfig patchwork_hdl64_profile() {
  return {.zone_rings = {8, 3, 4, 8},
          .zone_sectors = {48, 90, 90, 90},
          .low_cut_below_ground_m = 3.0,
          .min_points = 3,
          .lowest_points = 20,
          .lowest_margin = 1.5,
          .seed_height_m = 0.3,
          .ground_thickness_m = 0.075,
          .iterations = 3,
          .min_uprightness = 0.8,
          .max_elevation_m = {0.523, 0.7246, 0.872, 1.118},
          .max_surface_variation = {0.0, 0.0, 0.0, 0.0}};
}

}  // namespace pago
