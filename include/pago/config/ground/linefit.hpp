// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.linefit] Himmelsbach, v. Hundelshausen and Wuensche, "Fast segmentation of 3D point clouds for
/// ground vehicles", IV 2010. Defaults are those that the implementation of Wellhausen
/// (lorenwel/linefit_ground_segmentation) names for KITTI and the Patchwork authors' benchmark uses.
struct LinefitConfig {
  double min_range_m = 0.5;
  double max_range_m = 50.0;
  int bins = 120;
  int segments = 360;
  double max_distance_to_line_m = 0.05;
  double max_fit_error_m = 0.05;
  double max_slope = 0.3;
  double min_slope = 0.0;
  double long_gap_m = 1.0;
  double max_long_step_m = 0.1;
  double max_start_step_m = 0.2;
  double line_reach_m = 0.1;
  double line_search_angle_rad = 0.1;
};

template <typename Visitor>
void describe(Visitor& v, LinefitConfig& c) {
  v("min_range_m", c.min_range_m, within(0.0, 20.0),
    "horizontal; nearer returns are non-ground (KITTI: 0.5)");
  v("max_range_m", c.max_range_m, within(1.0, 200.0),
    "horizontal; farther returns are non-ground (KITTI: 50)");
  v("bins", c.bins, within(2, 1000),
    "rings, equally wide, of each of which the lowest return counts (KITTI: 120)");
  v("segments", c.segments, within(4, 3600), "sectors, each with lines of its own (KITTI: 360)");
  v("max_distance_to_line_m", c.max_distance_to_line_m, within(0.001, 2.0),
    "returns less than this above or below their segment's line are ground (KITTI: 0.05; code's default: "
    "0.15)");
  v("max_fit_error_m", c.max_fit_error_m, within(0.001, 2.0),
    "a line ends before the return that would leave one of its returns farther off than this (KITTI: 0.05)");
  v("max_slope", c.max_slope, within(0.01, 10.0), "rise over run of a line at most (KITTI: 0.3)");
  v("min_slope", c.min_slope, within(0.0, 10.0),
    "rise over run of a line of three and more at least (KITTI: 0)");
  v("long_gap_m", c.long_gap_m, within(0.01, 50.0),
    "from the first gap wider than this on, a line must foretell its returns, and none begins over one "
    "(KITTI: 1)");
  v("max_long_step_m", c.max_long_step_m, within(0.001, 5.0),
    "how far a foretold return may be off (KITTI: 0.1)");
  v("max_start_step_m", c.max_start_step_m, within(0.001, 5.0),
    "a line begins where a return is less than this above or below the end of the line before; the first "
    "one, "
    "below the sensor by mount.height_m (KITTI: 0.2)");
  v("line_reach_m", c.line_reach_m, within(0.0, 5.0), "a line holds this far beyond its ends (code: 0.1)");
  v("line_search_angle_rad", c.line_search_angle_rad, within(0.0, 1.0),
    "returns without a line look for one to both sides up to this (KITTI: 0.1; code's default: 0.2)");
}

}  // namespace pago
