// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.patchworkpp] Lee, Lim and Myung, "Patchwork++: Fast and Robust Ground Segmentation Solving Partial
/// Under-Segmentation Using 3D Point Cloud", IROS 2022. Defaults are the authors' code's for the HDL-64E,
/// except max_height_change_m and max_elevation_m. It learns from sweep to sweep: the mask depends on
/// what came before.
struct PatchworkppConfig {
  double min_range_m = 2.7;
  double max_range_m = 80.0;
  std::array<double, 4> zone_rings{2, 4, 4, 4};
  std::array<double, 4> zone_sectors{16, 32, 54, 32};

  bool removes_reflections = true;
  double reflection_angle_deg = -15.0;
  double reflection_depth_m = 0.8;
  double reflection_intensity = 0.2;

  bool removes_uprights = true;
  double upright_seed_height_m = 0.25;
  double upright_thickness_m = 0.1;

  int min_points = 10;
  int lowest_points = 20;
  double lowest_margin = 1.2;
  double seed_height_m = 0.125;
  double ground_thickness_m = 0.125;
  int iterations = 3;
  double min_uprightness = 0.707;

  bool reverts = true;
  double max_line_ratio = 8.0;
  int large_points = 1500;

  int memory = 1000;
  double max_elevation_m = 1.0;
  double max_height_change_m = 0.3;
};

template <typename Visitor>
void describe(Visitor& v, PatchworkppConfig& c) {
  v("min_range_m", c.min_range_m, within(0.0, 20.0),
    "horizontal; returns up to this range are non-ground: the vehicle itself (code: 2.7)");
  v("max_range_m", c.max_range_m, within(5.0, 200.0), "horizontal; returns beyond are non-ground (code: 80)");
  v("zone_rings", c.zone_rings, within(1.0, 64.0),
    "rings in each of the four zones, whole numbers; zones as Patchwork's (code: 2 4 4 4)");
  v("zone_sectors", c.zone_sectors, within(3.0, 360.0),
    "sectors in each zone, whole numbers (code: 16 32 54 32)");
  v("removes_reflections", c.removes_reflections,
    "whether mirror images under the ground are dropped (code: true)");
  v("reflection_angle_deg", c.reflection_angle_deg, within(-90.0, 0.0),
    "mirror images are seen below this elevation angle (code: -15)");
  v("reflection_depth_m", c.reflection_depth_m, within(0.0, 10.0),
    "and deeper under the ground than this (code: 0.8)");
  v("reflection_intensity", c.reflection_intensity, within(0.0, 1.0),
    "and with less than this part of full intensity (code: 0.2)");
  v("removes_uprights", c.removes_uprights,
    "whether walls in the first zone are taken out before planes are fitted (code: true)");
  v("upright_seed_height_m", c.upright_seed_height_m, within(0.01, 5.0),
    "returns less than this above the lowest ones' mean start such a wall (code: 0.25)");
  v("upright_thickness_m", c.upright_thickness_m, within(0.01, 2.0),
    "returns nearer to it than this are on the wall (code: 0.1)");
  v("min_points", c.min_points, within(3, 10000),
    "bins with fewer returns than this are non-ground (code: 10)");
  v("lowest_points", c.lowest_points, within(1, 1000),
    "the mean height of a bin's this many lowest returns is where its ground is looked for (code: 20)");
  v("lowest_margin", c.lowest_margin, within(1.0, 10.0),
    "in the first zone, returns lower than this x the height below the sensor are passed over among the "
    "lowest "
    "(code: 1.2)");
  v("seed_height_m", c.seed_height_m, within(0.01, 5.0),
    "returns less than this above the lowest ones' mean start the plane (code: 0.125)");
  v("ground_thickness_m", c.ground_thickness_m, within(0.01, 2.0),
    "returns less than this above the plane are on it, and so are all under it (code: 0.125)");
  v("iterations", c.iterations, within(1, 20),
    "how often the plane is fitted anew, and walls at most taken out of a bin (code: 3)");
  v("min_uprightness", c.min_uprightness, within(0.0, 1.0),
    "a plane whose unit normal's z is not more is no ground (code: 0.707 = 45 deg)");
  v("reverts", c.reverts,
    "whether elevated planes of the four inner rings are ground after all where they are as flat as their "
    "ring's (code: true)");
  v("max_line_ratio", c.max_line_ratio, within(1.0, 1000000.0),
    "planes whose largest variance is more than this times the second are lines and stay refused (code: 8)");
  v("large_points", c.large_points, within(1, 1000000),
    "planes of more returns than this are accepted if their deviation is below ground_thickness_m (code: "
    "1500)");
  v("memory", c.memory, within(2, 10000),
    "how many of each inner ring's latest planes the bounds on elevation and flatness are learnt from (code: "
    "1000)");
  v("max_elevation_m", c.max_elevation_m, within(0.0, 100.0),
    "the bounds on the elevation of the inner rings begin at this above the ground, as mount.height_m has "
    "it, "
    "and are learnt within this above and below it (code: begin at the sensor, no bound)");
  v("max_height_change_m", c.max_height_change_m, within(0.0, 10.0),
    "the learnt height of the sensor stays within this of mount.height_m (code: no bound)");
}

}  // namespace pago
