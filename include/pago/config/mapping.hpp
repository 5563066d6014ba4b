// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [mapping.cells] The local map: a hash of cubic cells, each with the mean and the spread of its points.
/// Values from the measured trial in spec/odometry-prototype.md section 3.
struct CellsConfig {
  double cell_m = 1.0;
  int max_points = 200;
  int min_points = 6;
  double max_flatness = 0.1;
  double max_thickness_m = 0.2;
  double min_width_m = 0.1;
  int max_cells = 170'000;
  double radius_m = 100.0;
};

template <typename Visitor>
void describe(Visitor& v, CellsConfig& c) {
  v("cell_m", c.cell_m, within(0.1, 10.0), "side of a cell");
  v("max_points", c.max_points, within(3, 10000), "later points of a cell are not counted");
  v("min_points", c.min_points, within(3, 1000), "fewer points make no plane");
  v("max_flatness", c.max_flatness, within(0.001, 1.0), "of a plane: its least variance over the middle one");
  v("max_thickness_m", c.max_thickness_m, within(0.01, 2.0),
    "of a plane: deviation of its points along the normal");
  v("min_width_m", c.min_width_m, within(0.0, 1.0),
    "of a plane: deviation of its points along its narrower side; the noise of ranges alone gives a ring's "
    "arc some");
  v("max_cells", c.max_cells, within(1000, 4'000'000), "room for so many; 108 bytes each");
  v("radius_m", c.radius_m, within(10.0, 1000.0), "cells farther from the sensor are given up");
}

/// [mapping.start] The motions that the first sweeps are tried with.
struct StartConfig {
  bool search = true;
  double max_speed_m_s = 30.0;
  double speed_step_m_s = 4.0;
  double turn_rate_deg_s = 20.0;
  double kernel_m = 0.3;
};

template <typename Visitor>
void describe(Visitor& v, StartConfig& c) {
  v("search", c.search, "find out how the vehicle moves at the start; false: it stands");
  v("max_speed_m_s", c.max_speed_m_s, within(0.0, 100.0), "highest speed that is tried");
  v("speed_step_m_s", c.speed_step_m_s, within(1.0, 50.0),
    "steps of the speeds tried; the first backwards, too");
  v("turn_rate_deg_s", c.turn_rate_deg_s, within(0.0, 90.0),
    "up to half the highest speed, turns to either side are tried");
  v("kernel_m", c.kernel_m, within(0.01, 2.0),
    "width of the kernel while motions are tried: most points fit any of them, those that do not must count");
}

/// [mapping.trust] When a registration is not believed.
struct TrustConfig {
  int min_matches = 100;
  double min_contribution = 5.0;
  double min_score_ratio = 0.5;
  double max_correction_m = 2.0;
  double max_correction_deg = 5.0;
  double max_acceleration_m_s2 = 40.0;
  int relocalise_after = 5;
  int restart_after = 20;
  int lost_after = 5;
};

template <typename Visitor>
void describe(Visitor& v, TrustConfig& c) {
  v("min_matches", c.min_matches, within(6, 10000), "fewer matches: prediction instead");
  v("min_contribution", c.min_contribution, within(0.0, 1000.0),
    "a direction of motion for which fewer matches in different places (blocks of 4 m) speak, by squared "
    "cosine: the pose "
    "is used, but called not observable");
  v("min_score_ratio", c.min_score_ratio, within(0.0, 1.0),
    "a sweep that fits the map by less than this part of what was usual lately: prediction instead");
  v("max_correction_m", c.max_correction_m, within(0.01, 100.0),
    "a pose farther from the predicted one is implausible; more after failures");
  v("max_correction_deg", c.max_correction_deg, within(0.1, 180.0), "the same for rotation");
  v("max_acceleration_m_s2", c.max_acceleration_m_s2, within(1.0, 1000.0),
    "and for the change of velocity; on a speed bump a roof sees 20 m/s^2");
  v("relocalise_after", c.relocalise_after, within(1, 1000),
    "failures in a row after which the pose is sought in the whole neighbourhood");
  v("restart_after", c.restart_after, within(2, 10000),
    "failures in a row after which the map is begun anew");
  v("lost_after", c.lost_after, within(1, 1000), "predicted sweeps in a row until the state is LOST");
}

/// [mapping.keyframes] The sweeps that stand for the drive: what the saved map is made of.
struct KeyframesConfig {
  double distance_m = 1.0;
  double angle_deg = 10.0;
};

template <typename Visitor>
void describe(Visitor& v, KeyframesConfig& c) {
  v("distance_m", c.distance_m, within(0.0, 1000.0), "a keyframe is at least so far from the last one");
  v("angle_deg", c.angle_deg, within(0.0, 180.0), "or turned by so much");
}

/// What sweeps are registered to.
enum class MappingMethod {
  kCells,     ///< Gaussian cells, every sweep: PaGO's own
  kKeyframes  ///< the features of keyframes around, every few sweeps: LeGO-LOAM's and PaGO-LOAM's
};

/// [mapping.keyframe_map] What is particular to method = keyframes: scan-to-map as PaGO-LOAM's code has it,
/// without loop closing. Of [mapping] it uses point_sigma_m (for the covariance) and keyframes (which sweeps
/// the saved map is of).
struct KeyframeMapConfig {
  int every_sweeps = 2;
  double min_interval_s = 0.3;
  double radius_m = 50.0;
  double thinning_m = 1.0;
  double keyframe_distance_m = 0.3;
  double row_voxel_m = 0.2;
  double edge_voxel_m = 0.2;
  double planar_voxel_m = 0.4;
  int max_iterations = 10;
  double update_gain = 1.0;
  double match_radius_m = 1.0;
  int min_matches = 50;
  double stop_translation_m = 0.0005;
  double stop_rotation_rad = 0.000873;
  double min_eigenvalue = 100.0;
  bool deskew = false;
};

template <typename Visitor>
void describe(Visitor& v, KeyframeMapConfig& c) {
  v("every_sweeps", c.every_sweeps, within(1, 100),
    "every so many-th sweep may be registered (LeGO-LOAM: 2, skipFrameNum 1)");
  v("min_interval_s", c.min_interval_s, within(0.0, 60.0),
    "and at least so long after the last one that was (LeGO-LOAM: 0.3)");
  v("radius_m", c.radius_m, within(5.0, 1000.0), "keyframes this near make up the map (LeGO-LOAM: 50)");
  v("thinning_m", c.thinning_m, within(0.0, 100.0),
    "of them one per voxel of this side, that of the mean index; 0: all (LeGO-LOAM: 1)");
  v("keyframe_distance_m", c.keyframe_distance_m, within(0.0, 100.0),
    "a registered sweep this far from the last keyframe becomes one (LeGO-LOAM: 0.3)");
  v("row_voxel_m", c.row_voxel_m, within(0.0, 5.0),
    "planar points are means over voxels of this side, row by row; 0: as they are (LeGO-LOAM: 0.2)");
  v("edge_voxel_m", c.edge_voxel_m, within(0.01, 5.0),
    "edges, of a sweep and of the map, are means over voxels of this side (LeGO-LOAM: 0.2)");
  v("planar_voxel_m", c.planar_voxel_m, within(0.01, 5.0), "the same for planar points (LeGO-LOAM: 0.4)");
  v("max_iterations", c.max_iterations, within(1, 100), "of matching and solving (LeGO-LOAM: 10)");
  v("update_gain", c.update_gain, within(0.01, 1.0),
    "part of each Gauss-Newton step that is taken (LeGO-LOAM: 1)");
  v("match_radius_m", c.match_radius_m, within(0.1, 20.0),
    "the farthest of the five neighbours must be nearer (LeGO-LOAM: 1)");
  v("min_matches", c.min_matches, within(6, 10000), "fewer matches: no step (LeGO-LOAM: 50)");
  v("stop_translation_m", c.stop_translation_m, within(0.0, 1.0),
    "a step that moves less ends the search (LeGO-LOAM: 0.0005)");
  v("stop_rotation_rad", c.stop_rotation_rad, within(0.0, 0.1), "and turns less (LeGO-LOAM: 0.05 degrees)");
  v("min_eigenvalue", c.min_eigenvalue, within(0.0, 1e9),
    "directions whose eigenvalue of J^T J is less stay as guessed (LeGO-LOAM: 100)");
  v("deskew", c.deskew, "move every return to one instant by odometry's motion (PaGO-LOAM's code: no)");
}

/// [mapping] Scan-to-map registration: the refined pose.
/// [mapping.lasers] What each laser measures wrong against the calibration.
struct LasersConfig {
  bool learn = true;
  double range_sigma_m = 0.01;
  double angle_sigma_deg = 0.03;
  double point_sigma_m = 0.03;
};

template <typename Visitor>
void describe(Visitor& v, LasersConfig& c) {
  v("learn", c.learn, "learn it from the local map, and correct returns for it before they are registered");
  v("range_sigma_m", c.range_sigma_m, within(1e-4, 1.0), "deviation of the lasers' errors of range");
  v("angle_sigma_deg", c.angle_sigma_deg, within(1e-4, 1.0), "and of each of their two angles");
  v("point_sigma_m", c.point_sigma_m, within(0.001, 1.0), "deviation of a single return from its plane");
}

struct MappingConfig {
  MappingMethod method = MappingMethod::kCells;
  KeyframeMapConfig keyframe_map;
  CellsConfig cells;
  StartConfig start;
  TrustConfig trust;
  KeyframesConfig keyframes;
  LasersConfig lasers;
  bool refine = true;
  int max_iterations = 8;
  double gate_m = 1.0;
  double point_sigma_m = 0.03;
  double kernel_min_m = 0.05;
  double stop_translation_m = 0.001;
  double stop_rotation_rad = 0.0001;
  double prior_weight = 0.3;
  double twist_sigma_m_s = 0.05;
  double twist_sigma_rad_s = 0.02;
  double acceleration_sigma_m_s2 = 1.0;
  double acceleration_sigma_rad_s2 = 0.1;
  double min_contribution = 1.0;
};

template <typename Visitor>
void describe(Visitor& v, MappingConfig& c) {
  v("method", c.method,
    choices(std::pair{"cells", MappingMethod::kCells}, std::pair{"keyframes", MappingMethod::kKeyframes}),
    "what sweeps are registered to: a local map of Gaussian cells, or features of the keyframes around as in "
    "LeGO-LOAM and PaGO-LOAM; keyframes allocates while it runs");
  v.section("keyframe_map", c.keyframe_map, "what is particular to method = keyframes");
  v.section("cells", c.cells, "the local map");
  v.section("start", c.start, "the motion that the sensor is switched on in");
  v.section("trust", c.trust, "when a registration is not believed");
  v.section("keyframes", c.keyframes, "the sweeps that the saved map is made of");
  v.section("lasers", c.lasers, "what each laser measures wrong against the calibration");
  v("refine", c.refine, "register sweeps to the map; false: refined poses are the first poses");
  v("max_iterations", c.max_iterations, within(1, 100), "most rounds of matching and solving in a sweep");
  v("gate_m", c.gate_m, within(0.05, 10.0), "points farther from the plane are not matched");
  v("point_sigma_m", c.point_sigma_m, within(0.001, 1.0),
    "deviation of a point from its plane by the sensor alone; thicker planes weigh less");
  v("kernel_min_m", c.kernel_min_m, within(0.001, 1.0),
    "least width of the Geman-McClure kernel, otherwise three times the residuals' robust deviation");
  v("stop_translation_m", c.stop_translation_m, within(0.0, 1.0), "a step that moves less ends the search");
  v("stop_rotation_rad", c.stop_rotation_rad, within(0.0, 0.1), "and turns less");
  v("prior_weight", c.prior_weight, within(0.0, 1.0),
    "how far the scan-to-scan motion is trusted beside the map, as part of its own information");
  v("twist_sigma_m_s", c.twist_sigma_m_s, within(1e-6, 10.0),
    "the velocity within a sweep is sought around that which the last motions make expect: deviation of its "
    "translation");
  v("twist_sigma_rad_s", c.twist_sigma_rad_s, within(1e-6, 10.0), "and of its rotation");
  v("acceleration_sigma_m_s2", c.acceleration_sigma_m_s2, within(1e-6, 100.0),
    "so is the change of that velocity in the course of the sweep: least deviation of its translation; more "
    "on "
    "rough roads");
  v("acceleration_sigma_rad_s2", c.acceleration_sigma_rad_s2, within(1e-6, 100.0), "and of its rotation");
  v("min_contribution", c.min_contribution, within(0.0, 1000.0),
    "a direction of motion for which fewer matches in different places speak, by squared cosine, is kept as "
    "predicted");
}

}  // namespace pago
