// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.ransac] The plane that most returns lie on, by random samples (Fischler and Bolles 1981, with the
/// stopping rule of PCL's SACSegmentation). Values of the Patchwork authors' benchmark
/// (url-kaist/Ground-Segmentation-Benchmark) are given as such; it leaves the sign of the normal to chance.
struct RansacConfig {
  double inlier_distance_m = 0.15;
  int max_iterations = 100;
  double confidence = 0.99;
  double ground_thickness_m = 0.3;
  double max_tilt_deg = 45.0;
  int seed = 1;
};

template <typename Visitor>
void describe(Visitor& v, RansacConfig& c) {
  v("inlier_distance_m", c.inlier_distance_m, within(0.01, 2.0),
    "returns nearer to a plane than this vote for it, and the winner is fitted to them (benchmark: 0.15)");
  v("max_iterations", c.max_iterations, within(1, 10000),
    "planes tried at most (benchmark: 50, PCL's default)");
  v("confidence", c.confidence, within(0.5, 0.999999),
    "trying ends when a better plane has been met with this probability (PCL: 0.99)");
  v("ground_thickness_m", c.ground_thickness_m, within(0.01, 2.0),
    "returns less than this above the plane are ground, and so are all under it (benchmark: 0.3, as margin)");
  v("max_tilt_deg", c.max_tilt_deg, within(1.0, 90.0),
    "steeper planes are not tried: a wall may hold more returns than the ground (benchmark: 90, none "
    "refused)");
  v("seed", c.seed, within(0, 2147483647), "of the random samples; each sweep begins with it anew");
}

}  // namespace pago
