// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.patchwork] Lim, Oh and Myung, "Patchwork: Concentric Zone-based Region-wise Ground Segmentation
/// with Ground Likelihood Estimation Using a 3D LiDAR Sensor", RA-L 2021. Defaults are the paper's for the
/// HDL-64E, except low_cut_below_ground_m. Heights are above the ground, which is mount.height_m below the
/// sensor (the paper's code: 1.723 m).
struct PatchworkConfig {
  double min_range_m = 2.7;
  double max_range_m = 80.0;
  std::array<double, 4> zone_rings{2, 4, 4, 4};
  std::array<double, 4> zone_sectors{16, 32, 54, 32};
  double low_cut_below_ground_m = 2.0;
  int min_points = 10;
  int lowest_points = 20;
  double lowest_margin = 1.1;
  double seed_height_m = 0.5;
  double ground_thickness_m = 0.125;
  int iterations = 3;
  double min_uprightness = 0.707;
  std::array<double, 4> max_elevation_m{0.523, 0.7246, 0.872, 1.118};
  std::array<double, 4> max_surface_variation{0.0, 0.000125, 0.000185, 0.000185};
  double max_elevation_beyond_m = 100.0;
};

/// [ground.patchwork_hdl64] The profile `patchwork-hdl64`: the same method with settings that were chosen for
/// the HDL-64E on simulated drives (docs/ground.md says how).
PatchworkConfig patchwork_hdl64_profile();

template <typename Visitor>
void describe(Visitor& v, PatchworkConfig& c) {
  v("min_range_m", c.min_range_m, within(0.0, 20.0),
    "horizontal; returns up to this range are non-ground: the vehicle itself (paper: 2.7)");
  v("max_range_m", c.max_range_m, within(5.0, 200.0),
    "horizontal; returns beyond are non-ground (paper: 80)");
  v("zone_rings", c.zone_rings, within(1.0, 64.0),
    "rings in each of the four zones, whole numbers; the zones end at (7 min + max)/8, (3 min + max)/4, "
    "(min + max)/2 and max (paper: 2 4 4 4)");
  v("zone_sectors", c.zone_sectors, within(3.0, 360.0),
    "sectors in each zone, whole numbers (paper: 16 32 54 32)");
  v("low_cut_below_ground_m", c.low_cut_below_ground_m, within(0.1, 100.0),
    "returns deeper under the ground than this are mirror images and non-ground (paper's code: 0.8 x "
    "mount.height_m = 1.378; its ROS 2 successor: 2)");
  v("min_points", c.min_points, within(2, 10000),
    "bins with no more returns than this are non-ground (paper: 10)");
  v("lowest_points", c.lowest_points, within(1, 1000),
    "the mean height of a bin's this many lowest returns is where its ground is looked for (paper: 20)");
  v("lowest_margin", c.lowest_margin, within(1.0, 10.0),
    "in the first zone, returns lower than this x mount.height_m below the sensor are passed over among the "
    "lowest (paper's code: 1.1)");
  v("seed_height_m", c.seed_height_m, within(0.01, 5.0),
    "returns less than this above the lowest ones' mean start the plane (paper: 0.5)");
  v("ground_thickness_m", c.ground_thickness_m, within(0.01, 2.0),
    "returns less than this above the plane are on it, and so are all under it (paper: 0.125)");
  v("iterations", c.iterations, within(1, 20), "plane fits per bin (paper: 3)");
  v("min_uprightness", c.min_uprightness, within(0.0, 1.0),
    "a plane whose unit normal's z is less is no ground (paper: 0.707 = 45 deg)");
  v("max_elevation_m", c.max_elevation_m, within(-10.0, 100.0),
    "in each of the four innermost rings, a plane higher above the ground than this is a car's roof unless "
    "flat (paper: 0.523 0.7246 0.872 1.118)");
  v("max_surface_variation", c.max_surface_variation, within(0.0, 1.0),
    "in the same rings, an elevated plane is ground after all when less than this part of its variance is "
    "across it (paper, as flatness: 0 0.000125 0.000185 0.000185)");
  v("max_elevation_beyond_m", c.max_elevation_beyond_m, within(-10.0, 100.0),
    "the same bound for all farther rings, flat or not; 100 = none (paper: none; tree crowns over unseen "
    "ground need it)");
}

}  // namespace pago
