// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.cascaded] CascadedSeg: Narksri, Takeuchi, Ninomiya, Morales, Akai and Kawaguchi, "A slope-robust
/// cascaded ground segmentation in 3D point cloud for autonomous vehicles", ITSC 2018. Defaults are those of
/// the Patchwork authors' benchmark (url-kaist/Ground-Segmentation-Benchmark) where it differs from the
/// authors' code.
struct CascadedConfig {
  double min_range_m = 3.0;
  double max_range_m = 90.0;
  double max_slope_deg = 5.0;
  double max_upright_m = 0.5;
  int sections = 4;
  double inlier_distance_m = 0.08;
  int max_iterations = 100;
  double confidence = 0.99;
  double max_height_step_m = 5.0;
  double max_angle_deg = 16.0;
  int seed = 1;
};

template <typename Visitor>
void describe(Visitor& v, CascadedConfig& c) {
  v("min_range_m", c.min_range_m, within(0.0, 20.0), "horizontal; nearer returns are non-ground (code: 3)");
  v("max_range_m", c.max_range_m, within(5.0, 200.0),
    "horizontal; farther returns are non-ground (code: 90)");
  v("max_slope_deg", c.max_slope_deg, within(2.01, 45.0),
    "two rings on ground that rises so are as far apart as rings on one obstacle can be (benchmark: 5; code: "
    "10)");
  v("max_upright_m", c.max_upright_m, within(0.01, 5.0),
    "neighbouring rings that are nearer to each other and reach over more height than this are an obstacle "
    "(benchmark: 0.5; code: 0.08)");
  v("sections", c.sections, within(1, 4), "rings of regions with a plane each, in four quadrants (code: 4)");
  v("inlier_distance_m", c.inlier_distance_m, within(0.01, 2.0),
    "returns nearer to their region's plane than this are ground (benchmark: 0.08; code: 0.3)");
  v("max_iterations", c.max_iterations, within(1, 10000), "planes tried at most in a region (code: 100)");
  v("confidence", c.confidence, within(0.5, 0.999999),
    "trying ends when a better plane has been met with this probability (PCL: 0.99)");
  v("max_height_step_m", c.max_height_step_m, within(0.0, 100.0),
    "a region's plane that misses its inner neighbour's by more than this between them is replaced by it "
    "(benchmark: 5; code: 0.3)");
  v("max_angle_deg", c.max_angle_deg, within(0.0, 90.0),
    "the same for the angle between the two planes (benchmark: 16; code: 5)");
  v("seed", c.seed, within(0, 2147483647), "of the random samples; each sweep begins with it anew");
}

}  // namespace pago
