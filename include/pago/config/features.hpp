// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// Which range image clusters and features are found in.
enum class Projection {
  kRing,    ///< the sweep's own: one cell per firing, every return in its own
  kUniform  ///< LeGO-LOAM's grid of equal angles: of the returns in a pixel the last one stays
};

/// [features.grid] The grid of equal angles: 64 rows of this step (LeGO-LOAM, for the HDL-64E). Such a unit's
/// rows are 1/3 and 1/2 degree apart, so some pixels get two rings and some none.
struct UniformGridConfig {
  int columns = 1800;
  double row_step_deg = 0.427;
  double bottom_deg = 24.9;
};

template <typename Visitor>
void describe(Visitor& v, UniformGridConfig& c) {
  v("columns", c.columns, within(16, 4096), "of the uniform grid (PaGO-LOAM: 1800)");
  v("row_step_deg", c.row_step_deg, within(0.01, 10.0), "height of one of its 64 rows (PaGO-LOAM: 0.427)");
  v("bottom_deg", c.bottom_deg, within(0.0, 90.0),
    "angle below the horizon at which it begins (PaGO-LOAM: 24.9)");
}

/// Which cells may belong to one segment.
enum class Neighbours {
  kFour,     ///< above, below, left and right: Bogoslavskyi and Stachniss, LeGO-LOAM
  kDiagonal  ///< the four across corners: PaGO-LOAM's code
};

/// [features.clustering] Range-image segmentation (Bogoslavskyi and Stachniss 2016, as in LeGO-LOAM).
struct ClusteringConfig {
  Neighbours neighbours = Neighbours::kFour;
  double join_angle_deg = 60.0;
  int min_points = 30;
  int min_points_tall = 5;
  int min_rings_tall = 3;
};

template <typename Visitor>
void describe(Visitor& v, ClusteringConfig& c) {
  v("neighbours", c.neighbours,
    choices(std::pair{"four", Neighbours::kFour}, std::pair{"diagonal", Neighbours::kDiagonal}),
    "cells that are held against each other: beside and above, or across corners (PaGO-LOAM's code: "
    "diagonal)");
  v("join_angle_deg", c.join_angle_deg, within(1.0, 89.0),
    "neighbouring returns belong together when the line between them is steeper than this against the far "
    "beam "
    "(LeGO-LOAM: 60)");
  v("min_points", c.min_points, within(1, 100000),
    "a segment of this many returns is trusted (LeGO-LOAM: 30)");
  v("min_points_tall", c.min_points_tall, within(1, 100000),
    "fewer suffice where the segment spans min_rings_tall rings, as poles do (LeGO-LOAM: 5)");
  v("min_rings_tall", c.min_rings_tall, within(1, 64), "see min_points_tall (LeGO-LOAM: 3)");
}

/// [features.thinning] Which returns the local map and saved maps are made of.
struct ThinningConfig {
  double min_range_m = 3.0;
  double max_range_m = 100.0;
  double dense_spacing_m = 0.15;
  double map_voxel_m = 0.4;
  double key_voxel_m = 1.0;
  int key_points = 4000;
};

template <typename Visitor>
void describe(Visitor& v, ThinningConfig& c) {
  v("min_range_m", c.min_range_m, within(0.0, 20.0), "closer returns stay out of every map");
  v("max_range_m", c.max_range_m, within(5.0, 200.0), "and so do those farther away");
  v("dense_spacing_m", c.dense_spacing_m, within(0.01, 5.0),
    "saved maps keep returns about so far apart along a ring");
  v("map_voxel_m", c.map_voxel_m, within(0.1, 5.0),
    "of these the local map takes one per voxel of this side; at most 0.4 of mapping.cell_m, or cells stay "
    "empty");
  v("key_voxel_m", c.key_voxel_m, within(0.1, 10.0), "and of these one per voxel of this side is registered");
  v("key_points", c.key_points, within(50, 8000), "but no more than this, chosen at random");
}

/// How the range differences around a return are made comparable.
enum class Smoothness {
  kRangeSquared,  ///< c = (sum of r_k - r_i)^2, in m^2: LeGO-LOAM's, the same threshold at every range
  kNormalised     ///< c = |sum of r_k - r_i| / (10 r_i): LOAM's, in parts of the range
};

/// What planar points are found on.
enum class PlanarSource {
  kBoth,       ///< ground and other surfaces: the text of LeGO-LOAM
  kGroundOnly  ///< ground alone: its code, and PaGO-LOAM's
};

/// [features]
struct FeaturesConfig {
  Projection projection = Projection::kRing;
  UniformGridConfig grid;
  ClusteringConfig clustering;
  ThinningConfig thinning;
  double min_range_m = 1.0;
  Smoothness smoothness = Smoothness::kNormalised;
  double edge_threshold = 0.05;
  double planar_threshold = 0.005;
  int sectors = 6;
  int sharp_edges_per_sector = 2;
  int edges_per_sector = 20;
  int flat_planars_per_sector = 4;
  PlanarSource planar_source = PlanarSource::kBoth;
  int planars_per_sector = 0;
  int ground_every_columns = 1;
  int outlier_every_columns = 0;
  int outliers_above_row = 50;
  double occlusion_jump_m = 0.3;
  double parallel_beam_ratio = 0.02;
  double planar_spacing_m = 0.2;
};

template <typename Visitor>
void describe(Visitor& v, FeaturesConfig& c) {
  v("projection", c.projection,
    choices(std::pair{"ring", Projection::kRing}, std::pair{"uniform", Projection::kUniform}),
    "the range image that features are found in: one cell per firing, or a grid of equal angles where the "
    "last "
    "return of a pixel stays (PaGO-LOAM: uniform)");
  v.section("grid", c.grid, "the grid of equal angles of features.projection");
  v.section("clustering", c.clustering, "grouping of non-ground returns; small groups give no features");
  v.section("thinning", c.thinning, "returns for the local map and saved maps, of all kinds");
  v("min_range_m", c.min_range_m, within(0.1, 20.0), "closer returns give no features (LeGO-LOAM: 1.0)");
  v("smoothness", c.smoothness,
    choices(std::pair{"range_squared", Smoothness::kRangeSquared},
            std::pair{"normalised", Smoothness::kNormalised}),
    "smoothness measure: LeGO-LOAM's squared range sum (m^2), or LOAM's, divided by the range");
  v("edge_threshold", c.edge_threshold, within(1e-6, 100.0),
    "edges are rougher than this, in the measure's unit (LeGO-LOAM: 0.1 m^2)");
  v("planar_threshold", c.planar_threshold, within(1e-6, 100.0), "planar points are smoother than this");
  v("sectors", c.sectors, within(1, 64), "each ring is searched in this many sectors (LeGO-LOAM: 6)");
  v("sharp_edges_per_sector", c.sharp_edges_per_sector, within(0, 20), "edges to register (LeGO-LOAM: 2)");
  v("edges_per_sector", c.edges_per_sector, within(0, 40), "edges to register against (LeGO-LOAM: 20)");
  v("flat_planars_per_sector", c.flat_planars_per_sector, within(0, 10),
    "planar points to register, of ground and of other surfaces each (LeGO-LOAM: 4, ground only)");
  v("planar_source", c.planar_source,
    choices(std::pair{"both", PlanarSource::kBoth}, std::pair{"ground", PlanarSource::kGroundOnly}),
    "where planar points to register are found: on all surfaces, or on ground alone (PaGO-LOAM's code: "
    "ground)");
  v("planars_per_sector", c.planars_per_sector, within(0, 1000),
    "planar points to register against, the flattest of each sector; 0: all that is no edge (LeGO-LOAM's "
    "text: 80, "
    "its code: all)");
  v("ground_every_columns", c.ground_every_columns, within(1, 100),
    "ground gives features in every so many-th column only (LeGO-LOAM: 5)");
  v("outlier_every_columns", c.outlier_every_columns, within(0, 100),
    "of segments too small to trust, the map of mapping.method = keyframes gets every so many-th column; 0: "
    "none "
    "(LeGO-LOAM: 5)");
  v("outliers_above_row", c.outliers_above_row, within(0, 63),
    "and these above this row only (PaGO-LOAM: 50)");
  v("occlusion_jump_m", c.occlusion_jump_m, within(0.01, 10.0),
    "a range jump beyond this hides the farther side: no features there (LeGO-LOAM: 0.3)");
  v("parallel_beam_ratio", c.parallel_beam_ratio, within(0.001, 1.0),
    "a range change beyond this part of the range on both sides means a grazing beam (LeGO-LOAM: 0.02)");
  v("planar_spacing_m", c.planar_spacing_m, within(0.0, 5.0),
    "planar points to register against are about so far apart along a ring; 0: all of them");
}

}  // namespace pago
