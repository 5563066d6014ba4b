// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/preset.hpp"

#include "pago/config/load.hpp"
#include "pago/core/error.hpp"

namespace pago {
namespace {

// Values that are also PaGO's own defaults are named as well: a preset must not follow them.
constexpr std::string_view kPaperCode =
    R"(# PaGO-LOAM's code (github.com/url-kaist/AlterGround-LeGO-LOAM at afcba08), for the HDL-64E.
[ground]
method = "patchwork"
[ground.patchwork]
low_cut_below_ground_m = 1.378  # 1.8 sensor heights below the sensor

[features]
projection = "uniform"
min_range_m = 1.0
smoothness = "range_squared"
edge_threshold = 0.1
planar_threshold = 0.1
sectors = 6
sharp_edges_per_sector = 2
edges_per_sector = 20
flat_planars_per_sector = 4
planar_source = "ground"
planars_per_sector = 0
planar_spacing_m = 0.0
ground_every_columns = 5
outlier_every_columns = 5
outliers_above_row = 50
occlusion_jump_m = 0.3
parallel_beam_ratio = 0.02
[features.grid]
columns = 1800
row_step_deg = 0.427
bottom_deg = 24.9
[features.clustering]
neighbours = "diagonal"
join_angle_deg = 60.0
min_points = 30
min_points_tall = 5
min_rings_tall = 3

[odometry]
registration = "loam"
deskew = false
update_gain = 0.05
max_rounds = 5       # of 5 steps: 25 for each of the two
steps_per_round = 5
match_radius_m = 5.0
stop_translation_m = 0.001
stop_rotation_rad = 0.001745  # 0.1 degrees
min_planar_matches = 10
min_edge_matches = 10
max_correction_m = 100.0      # no gate
max_correction_deg = 180.0
[odometry.loam]
target_voxel_m = 0.2
same_surface = false
min_eigenvalue = 10.0

[mapping]
method = "keyframes"
[mapping.keyframe_map]
every_sweeps = 2
min_interval_s = 0.3
radius_m = 50.0
thinning_m = 1.0
keyframe_distance_m = 0.3
row_voxel_m = 0.2
edge_voxel_m = 0.2
planar_voxel_m = 0.4
max_iterations = 10
update_gain = 1.0
match_radius_m = 1.0
min_matches = 50
stop_translation_m = 0.0005
stop_rotation_rad = 0.000873  # 0.05 degrees
min_eigenvalue = 100.0
deskew = false
)";

// What the texts say otherwise than the code does; the rest is the code's.
constexpr std::string_view kPaperText = R"([features]
smoothness = "normalised"     # LeGO-LOAM, equation 1
edge_threshold = 0.1
planar_threshold = 0.1
edges_per_sector = 40         # LeGO-LOAM, section IV: 2, 4, 40, 80
planars_per_sector = 80
planar_source = "both"        # PaGO-LOAM: planar features also inside the ground image
[features.clustering]
neighbours = "four"           # Bogoslavskyi and Stachniss, whom LeGO-LOAM follows

[odometry]
update_gain = 1.0             # both optimise until they converge
[odometry.loam]
target_voxel_m = 0.0
same_surface = true           # LeGO-LOAM: correspondences have the same label

[mapping.keyframe_map]
every_sweeps = 1
min_interval_s = 0.5          # LeGO-LOAM: the map at 2 Hz
radius_m = 100.0              # LeGO-LOAM: feature sets within 100 m
)";

std::string text_of_paper() {
  return std::string(kPaperCode) + "\n# --- The texts differ:\n" + std::string(kPaperText);
}

}  // namespace

void apply_preset(Config& config, Preset preset) {
  config.preset = preset;
  if (preset == Preset::kDefault) return;
  apply_toml(config, kPaperCode, "preset paper-code");
  if (preset == Preset::kPaperText) apply_toml(config, kPaperText, "preset paper-text");
}

Preset preset_of(std::string_view name) {
  std::string known;
  for (const auto& [word, preset] : preset_choices().words) {
    if (word == name) return preset;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw Error("preset", "'" + std::string(name) + "' is none", "there are " + known);
}

std::string preset_toml(Preset preset) {
  if (preset == Preset::kPaperCode) return std::string(kPaperCode);
  if (preset == Preset::kPaperText) return text_of_paper();
  return "# PaGO's own: every setting at its default.\n";
}

}  // namespace pago
