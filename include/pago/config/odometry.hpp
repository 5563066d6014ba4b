// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// The instant of a sweep that its pose holds for. Sweeps that are compensated already (KITTI odometry) keep
/// their own instant, the middle.
enum class PoseInstant { kStart, kMid, kEnd };

/// [odometry] Scan-to-scan registration in two steps (LeGO-LOAM section III.D, PaGO-LOAM).
struct OdometryConfig {
  PoseInstant pose_instant = PoseInstant::kEnd;
  bool deskew = true;
  bool walls_in_step_two = true;
  int max_rounds = 8;
  int steps_per_round = 2;
  double update_gain = 1.0;
  double match_radius_m = 2.0;
  double start_match_radius_m = 5.0;
  double kernel_min_m = 0.05;
  double stop_translation_m = 0.001;
  double stop_rotation_rad = 0.0001;
  int min_planar_matches = 60;
  int min_edge_matches = 20;
  double max_correction_m = 2.0;
  double max_correction_deg = 5.0;
  double residual_sigma_m = 0.05;
  double min_information_ratio = 0.001;
  int lost_after = 5;
};

template <typename Visitor>
void describe(Visitor& v, OdometryConfig& c) {
  v("pose_instant", c.pose_instant,
    choices(std::pair{"start", PoseInstant::kStart}, std::pair{"mid", PoseInstant::kMid},
            std::pair{"end", PoseInstant::kEnd}),
    "instant of the sweep that its pose holds for");
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
  v("start_match_radius_m", c.start_match_radius_m, within(0.1, 20.0), "the same while no motion is known");
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
  v("residual_sigma_m", c.residual_sigma_m, within(0.001, 1.0),
    "least deviation of one residual, for the covariance");
  v("min_information_ratio", c.min_information_ratio, within(0.0, 1.0),
    "a direction with less than this part of the strongest direction's information counts as not observable");
  v("lost_after", c.lost_after, within(1, 1000), "predicted sweeps in a row until the state is LOST");
}

}  // namespace pago
