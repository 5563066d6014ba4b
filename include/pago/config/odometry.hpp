// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// The instant of a sweep that its pose holds for. Sweeps that are compensated already (KITTI odometry) keep
/// their own instant, the middle.
enum class PoseInstant { kStart, kMid, kEnd };

/// What a feature is matched with in the last sweep.
enum class TargetKind {
  kCells,  ///< the plane or line through the features of a cubic cell
  kRings   ///< the plane or line through the nearest features, by ring: LOAM's
};

/// How two sweeps are registered.
enum class Registration {
  kTwoStep,  ///< rounds of both steps, many neighbours per match: PaGO's own
  kLoam      ///< all of step one, then all of step two, three points per plane: PaGO-LOAM's code
};

/// How residuals lose weight with their size.
enum class Kernel {
  kGemanMcClure,  ///< as wide as three times the residuals' robust deviation
  kLoam           ///< linearly, after the first round: LOAM's code
};

/// [odometry.cells] Targets as Gaussian cells.
struct CellTargetsConfig {
  double cell_m = 1.0;
  int max_points = 1000;
  int min_points = 6;
  int min_line_points = 8;
  double max_flatness = 0.1;
  double max_thickness_m = 0.2;
  double min_width_m = 0.1;
};

template <typename Visitor>
void describe(Visitor& v, CellTargetsConfig& c) {
  v("cell_m", c.cell_m, within(0.1, 10.0), "side of a cell");
  v("max_points", c.max_points, within(3, 10000), "later features of a cell are not counted");
  v("min_points", c.min_points, within(3, 1000), "fewer make no plane");
  v("min_line_points", c.min_line_points, within(2, 1000), "fewer edges make no line");
  v("max_flatness", c.max_flatness, within(0.001, 1.0),
    "of a plane: its least variance over the middle one; of a line: the middle one over the greatest");
  v("max_thickness_m", c.max_thickness_m, within(0.01, 2.0),
    "deviation of the features off their plane or line");
  v("min_width_m", c.min_width_m, within(0.0, 1.0),
    "of a plane: deviation of its points along its narrower side; the noise of ranges alone gives a ring's "
    "arc some");
}

/// [odometry.loam] What is particular to registration = loam. It uses of [odometry] max_rounds (matchings per
/// step), steps_per_round, update_gain, match_radius_m, stop_*, deskew and what judges a result; nothing
/// else.
struct LoamConfig {
  double target_voxel_m = 0.2;
  bool same_surface = false;
  double min_eigenvalue = 10.0;
};

template <typename Visitor>
void describe(Visitor& v, LoamConfig& c) {
  v("target_voxel_m", c.target_voxel_m, within(0.0, 5.0),
    "planar points to register against are means over voxels of this side, row by row; 0: as they are "
    "(LeGO-LOAM: "
    "0.2)");
  v("same_surface", c.same_surface,
    "ground is matched with ground and other surfaces with others (LeGO-LOAM's text: yes, its code: no)");
  v("min_eigenvalue", c.min_eigenvalue, within(0.0, 1e9),
    "directions of a step whose eigenvalue of J^T J is less stay as guessed (LeGO-LOAM: 10)");
}

/// [odometry] Scan-to-scan registration in two steps (LeGO-LOAM section III.D, PaGO-LOAM).
struct OdometryConfig {
  PoseInstant pose_instant = PoseInstant::kEnd;
  Registration registration = Registration::kTwoStep;
  LoamConfig loam;
  TargetKind targets = TargetKind::kCells;
  CellTargetsConfig cells;
  int ring_neighbours = 3;
  bool deskew = true;
  bool walls_in_step_two = true;
  int max_rounds = 8;
  int steps_per_round = 2;
  double update_gain = 1.0;
  double match_radius_m = 2.0;
  Kernel kernel = Kernel::kGemanMcClure;
  double kernel_min_m = 0.05;
  double stop_translation_m = 0.001;
  double stop_rotation_rad = 0.0001;
  int min_planar_matches = 60;
  int min_edge_matches = 20;
  double max_correction_m = 2.0;
  double max_correction_deg = 5.0;
  double point_sigma_m = 0.03;
  double edge_sigma_m = 0.2;
  double min_contribution = 1.0;
  int lost_after = 5;
};

template <typename Visitor>
void describe(Visitor& v, OdometryConfig& c) {
  v("pose_instant", c.pose_instant,
    choices(std::pair{"start", PoseInstant::kStart}, std::pair{"mid", PoseInstant::kMid},
            std::pair{"end", PoseInstant::kEnd}),
    "instant of the sweep that its pose holds for");
  v("registration", c.registration,
    choices(std::pair{"two_step", Registration::kTwoStep}, std::pair{"loam", Registration::kLoam}),
    "PaGO's registration, or that of LeGO-LOAM's and PaGO-LOAM's code; loam allocates while it runs");
  v.section("loam", c.loam, "what is particular to registration = loam");
  v("targets", c.targets,
    choices(std::pair{"cells", TargetKind::kCells}, std::pair{"rings", TargetKind::kRings}),
    "what features are matched with: Gaussian cells of the last sweep, or its features ring by ring (LOAM)");
  v.section("cells", c.cells, "targets as Gaussian cells");
  v("ring_neighbours", c.ring_neighbours, within(1, 3),
    "targets by ring: a plane is made of so many features of each of up to three rings");
  v("deskew", c.deskew,
    "move every return to one instant of the sweep by the motion found (the paper's code: no)");
  v("walls_in_step_two", c.walls_in_step_two,
    "planar points off the ground help the edges to find x, y and yaw (the paper's code: no)");
  v("max_rounds", c.max_rounds, within(1, 50), "most rounds of matching and solving both steps");
  v("steps_per_round", c.steps_per_round, within(1, 25),
    "Gauss-Newton steps between matchings (LeGO-LOAM: 5)");
  v("update_gain", c.update_gain, within(0.01, 1.0),
    "part of each Gauss-Newton step that is taken (the paper's code: 0.05)");
  v("match_radius_m", c.match_radius_m, within(0.1, 20.0),
    "features farther apart are not matched (LeGO-LOAM: 5)");
  v("kernel", c.kernel,
    choices(std::pair{"geman_mcclure", Kernel::kGemanMcClure}, std::pair{"loam", Kernel::kLoam}),
    "how residuals lose weight with their size");
  v("kernel_min_m", c.kernel_min_m, within(0.001, 1.0),
    "least width of the Geman-McClure kernel, otherwise three times the residuals' robust deviation");
  v("stop_translation_m", c.stop_translation_m, within(0.0, 1.0), "a round that moves less ends the search");
  v("stop_rotation_rad", c.stop_rotation_rad, within(0.0, 0.1), "and turns less");
  v("min_planar_matches", c.min_planar_matches, within(3, 10000), "fewer ground matches: prediction instead");
  v("min_edge_matches", c.min_edge_matches, within(3, 10000),
    "fewer matches for step two: prediction instead");
  v("max_correction_m", c.max_correction_m, within(0.01, 100.0),
    "a result farther from the prediction is implausible (once moving)");
  v("max_correction_deg", c.max_correction_deg, within(0.1, 180.0), "the same for rotation");
  v("point_sigma_m", c.point_sigma_m, within(0.001, 1.0),
    "deviation of a point from its plane by the sensor alone; thicker planes weigh less");
  v("edge_sigma_m", c.edge_sigma_m, within(0.001, 10.0),
    "the same for an edge and its line: where an edge is seen depends on where firings fall, in each sweep "
    "anew");
  v("min_contribution", c.min_contribution, within(0.0, 1000.0),
    "a direction of motion for which fewer matches in different places speak, by squared cosine, is kept as "
    "predicted");
  v("lost_after", c.lost_after, within(1, 1000), "predicted sweeps in a row until the state is LOST");
}

}  // namespace pago
