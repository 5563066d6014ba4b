// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.lego] The column test of Shan and Englot, "LeGO-LOAM", IROS 2018. Defaults are PaGO-LOAM's for the
/// HDL-64E.
struct LegoConfig {
  enum class Projection {
    kRing,    ///< the sweep's own range image: each return in its own cell
    kUniform  ///< LeGO-LOAM's grid of equal angles; a return takes its pixel's verdict
  };
  Projection projection = Projection::kRing;
  double max_slope_deg = 10.0;
  int ground_rings = 50;
  double min_range_m = 1.0;
  int uniform_rows = 64;
  int uniform_columns = 1800;
  double uniform_row_step_deg = 0.427;
  double uniform_bottom_deg = 24.9;
};

template <typename Visitor>
void describe(Visitor& v, LegoConfig& c) {
  v("projection", c.projection,
    choices(std::pair{"ring", LegoConfig::Projection::kRing},
            std::pair{"uniform", LegoConfig::Projection::kUniform}),
    "which returns count as vertical neighbours: those of neighbouring lasers, or of neighbouring pixels in "
    "a grid of equal angles (PaGO-LOAM: uniform)");
  v("max_slope_deg", c.max_slope_deg, within(0.1, 80.0),
    "two vertical neighbours are ground when the line between them is no steeper (LeGO-LOAM: 10)");
  v("ground_rings", c.ground_rings, within(1, 63),
    "pairs above this row are not looked at (PaGO-LOAM: 50, groundScanInd)");
  v("min_range_m", c.min_range_m, within(0.0, 20.0), "closer returns are non-ground (LeGO-LOAM: 1)");
  v("uniform_rows", c.uniform_rows, within(2, 256), "rows of the uniform grid (PaGO-LOAM: 64)");
  v("uniform_columns", c.uniform_columns, within(16, 8192), "columns of the uniform grid (PaGO-LOAM: 1800)");
  v("uniform_row_step_deg", c.uniform_row_step_deg, within(0.01, 10.0),
    "height of a row of the uniform grid (PaGO-LOAM: 0.427)");
  v("uniform_bottom_deg", c.uniform_bottom_deg, within(0.0, 90.0),
    "angle below the horizon at which the uniform grid begins (PaGO-LOAM: 24.9)");
}

}  // namespace pago
