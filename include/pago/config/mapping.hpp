// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [mapping.cells] The local map: a hash of cubic cells, each with the mean and the spread of its points. Values
/// from the measured trial in spec/odometry-prototype.md section 3.
struct CellsConfig {
  double cell_m = 1.0;
  int max_points = 30;
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
  v("max_thickness_m", c.max_thickness_m, within(0.01, 2.0), "of a plane: deviation of its points along the normal");
  v("min_width_m", c.min_width_m, within(0.0, 1.0),
    "of a plane: deviation of its points along its narrower side; the noise of ranges alone gives a ring's arc some");
  v("max_cells", c.max_cells, within(1000, 4'000'000), "room for so many; 108 bytes each");
  v("radius_m", c.radius_m, within(10.0, 1000.0), "cells farther from the sensor are given up");
}

/// [mapping] Scan-to-map registration: the refined pose.
struct MappingConfig {
  CellsConfig cells;
  int max_iterations = 8;
  double gate_m = 1.0;
  double point_sigma_m = 0.03;
  double kernel_min_m = 0.05;
  double stop_translation_m = 0.001;
  double stop_rotation_rad = 0.0001;
};

template <typename Visitor>
void describe(Visitor& v, MappingConfig& c) {
  v.section("cells", c.cells, "the local map");
  v("max_iterations", c.max_iterations, within(1, 100), "most rounds of matching and solving in a sweep");
  v("gate_m", c.gate_m, within(0.05, 10.0), "points farther from the plane are not matched");
  v("point_sigma_m", c.point_sigma_m, within(0.001, 1.0),
    "deviation of a point from its plane by the sensor alone; thicker planes weigh less");
  v("kernel_min_m", c.kernel_min_m, within(0.001, 1.0),
    "least width of the Geman-McClure kernel, otherwise three times the residuals' robust deviation");
  v("stop_translation_m", c.stop_translation_m, within(0.0, 1.0), "a step that moves less ends the search");
  v("stop_rotation_rad", c.stop_rotation_rad, within(0.0, 0.1), "and turns less");
}

}  // namespace pago
