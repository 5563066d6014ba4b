// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/ground/patchwork.hpp"

namespace pago {

/// By a coordinate search on simulated sweeps, described in docs/ground.md. The bounds on elevation are those
/// of narrower rings than the paper's: all four lie in the innermost zone. Set by reason, not by the search:
/// no bound is above 1.2 m, and no flat plane above it is ground: in bins so small a roof is alone, and flat.
PatchworkConfig patchwork_hdl64_profile() {
  return {.zone_rings = {4, 4, 5, 6},
          .zone_sectors = {24, 64, 90, 64},
          .low_cut_below_ground_m = 3.0,
          .min_points = 3,
          .lowest_points = 30,
          .lowest_margin = 1.5,
          .seed_height_m = 0.2,
          .ground_thickness_m = 0.09,
          .iterations = 4,
          .min_uprightness = 0.97,
          .max_elevation_m = {0.523, 1.2, 1.1, 1.2},
          .max_surface_variation = {0.0, 0.0, 0.0, 0.0}};
}

}  // namespace pago
