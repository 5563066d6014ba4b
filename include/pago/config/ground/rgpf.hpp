// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.rgpf] Region-wise ground plane fitting, the ground module of Lim, Hwang and Myung, "ERASOR", RA-L
/// 2021, without any judgement of the planes. Defaults are those with which the authors' benchmark
/// (url-kaist/Ground-Segmentation-Benchmark) compares it on the HDL-64E.
struct RgpfConfig {
  double max_range_m = 80.0;
  int rings = 32;
  int sectors = 108;
  double low_cut_heights = 1.5;
  int min_points = 9;
  int lowest_points = 10;
  double seed_height_m = 0.4;
  double ground_thickness_m = 0.12;
  int iterations = 3;
};

template <typename Visitor>
void describe(Visitor& v, RgpfConfig& c) {
  v("max_range_m", c.max_range_m, within(5.0, 200.0),
    "horizontal; returns beyond are non-ground (benchmark: 80)");
  v("rings", c.rings, within(1, 200), "rings of the polar grid (benchmark: 32; ERASOR: 20)");
  v("sectors", c.sectors, within(3, 720), "sectors of the polar grid (benchmark and ERASOR: 108)");
  v("low_cut_heights", c.low_cut_heights, within(1.0, 10.0),
    "returns lower than this x mount.height_m below the sensor are mirror images and non-ground (benchmark: "
    "1.5)");
  v("min_points", c.min_points, within(2, 10000),
    "bins with no more returns than this are non-ground (benchmark: 9)");
  v("lowest_points", c.lowest_points, within(1, 1000),
    "the mean height of a bin's this many lowest returns is where its ground is looked for (benchmark: 10; "
    "ERASOR: 20)");
  v("seed_height_m", c.seed_height_m, within(0.01, 5.0),
    "returns less than this above the lowest ones' mean start the plane (benchmark: 0.4; ERASOR: 0.5)");
  v("ground_thickness_m", c.ground_thickness_m, within(0.01, 2.0),
    "returns less than this above the plane are on it, and so are all under it (benchmark: 0.12; ERASOR: "
    "0.15)");
  v("iterations", c.iterations, within(1, 20), "plane fits per bin (benchmark and ERASOR: 3)");
}

}  // namespace pago
