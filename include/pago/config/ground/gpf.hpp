// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.gpf] Ground plane fitting of Zermas, Izzat and Papanikolopoulos, "Fast segmentation of 3D point
/// clouds", ICRA 2017: one plane for the sweep, or one for each of three slabs along the vehicle. Defaults
/// are those of the Patchwork authors' benchmark (url-kaist/Ground-Segmentation-Benchmark).
struct GpfConfig {
  enum class Planes {
    kOne,    ///< one plane
    kSlabs,  ///< behind, beside and ahead, a plane each
  };
  Planes planes = Planes::kOne;
  double slab_m = 20.0;
  double low_cut_heights = 1.5;
  int lowest_points = 20;
  double seed_height_m = 0.6;
  double ground_thickness_m = 0.2;
  int iterations = 3;
};

template <typename Visitor>
void describe(Visitor& v, GpfConfig& c) {
  v("planes", c.planes,
    choices(std::pair{"one", GpfConfig::Planes::kOne}, std::pair{"slabs", GpfConfig::Planes::kSlabs}),
    "one plane, or one each behind, beside and ahead of the vehicle (paper: several along its way; "
    "benchmark: one)");
  v("slab_m", c.slab_m, within(1.0, 100.0),
    "the middle slab reaches this far ahead of and behind the sensor (benchmark: 20)");
  v("low_cut_heights", c.low_cut_heights, within(1.0, 10.0),
    "returns lower than this x mount.height_m below the sensor start no plane (benchmark: 1.5)");
  v("lowest_points", c.lowest_points, within(1, 10000),
    "the mean height of this many lowest returns is where the ground is looked for (benchmark: 20)");
  v("seed_height_m", c.seed_height_m, within(0.01, 5.0),
    "returns less than this above the lowest ones' mean start the plane (benchmark: 0.6; authors' code: "
    "1.2)");
  v("ground_thickness_m", c.ground_thickness_m, within(0.01, 2.0),
    "returns less than this above the plane are on it, and so are all under it (benchmark: 0.2; authors' "
    "code: 0.3)");
  v("iterations", c.iterations, within(1, 20), "plane fits (benchmark: 3)");
}

}  // namespace pago
