// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "pago/core/text.hpp"
#include "pago/evaluation/evaluation.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

std::string head(const Evaluation& e) {
  return "truth     " + e.truth_name + format(" (%zu poses)\n", e.truth_poses) +  //
         "estimate  " + e.estimate_name + format(" (%zu poses)\n", e.estimate_poses) +
         format("matched   %zu of %zu rows, ", e.num_matched, e.num_rows) + e.how + "\n";
}

std::string motion(const Evaluation& e) {
  const Motion& truth = e.truth_motion;
  const Motion& estimate = e.estimate_motion;
  std::string text = format("path      %.2f m, true %.2f m", estimate.path_length_m, truth.path_length_m);
  if (truth.path_length_m > 0.0)
    text += format(" (%+.2f %%)", 100.0 * (estimate.path_length_m / truth.path_length_m - 1.0));
  return text + format("\nyaw range %.2f deg, true %.2f deg\n", estimate.yaw_range_rad * kDegPerRad,
                       truth.yaw_range_rad * kDegPerRad);
}

std::string end(const FinalDrift& drift) {
  std::string text = format("end       off by %.3f m", drift.distance_m);
  if (std::isfinite(drift.percent)) text += format(" = %.3f %% of the path", drift.percent);
  return text + format(" (x %+.3f y %+.3f z %+.3f m), %.3f deg\n", drift.position_m.x(), drift.position_m.y(),
                       drift.position_m.z(), drift.rotation_rad * kDegPerRad);
}

std::string drift_row(const std::string& label, const DriftRates& rates) {
  const Eigen::Vector3d& t = rates.axis_percent;
  const Eigen::Vector3d& r = rates.axis_deg_per_100m;
  return format("  %-8s %8zu  %8.4f %8.4f %8.4f %8.4f  %8.4f %8.4f %8.4f %8.4f\n", label.c_str(),
                rates.num_segments, rates.t_rel_percent, t.x(), t.y(), t.z(), rates.r_rel_deg_per_100m, r.x(),
                r.y(), r.z());
}

std::string relative(const Evaluation& e) {
  if (e.relative.segments.empty()) return "";
  std::string text =
      format("relative error (KITTI's segments, a start every %d rows)\n", e.step_rows) +
      "                     translation, % of the length         rotation, deg/100 m\n"
      "  length m segments     t_rel        x        y        z     r_rel     roll    pitch      yaw\n";
  for (const DriftRates& rates : e.relative.by_length) text += drift_row(format("%g", rates.length_m), rates);
  return text + drift_row("all", e.relative.overall);
}

std::string sub_trajectories(const Evaluation& e) {
  if (e.sub_trajectories.empty()) return "";
  std::string text =
      "relative error (rpg's sub-trajectories: from every row to the row closest to the length)\n"
      "                     translation, %      rotation, deg/100 m    yaw, deg    tilt, deg\n"
      "  length m    pairs     mean   median        mean     median        mean         mean\n";
  for (const SubTrajectoryErrors& s : e.sub_trajectories)
    text +=
        format("  %-8.2f %8zu %8.4f %8.4f    %8.4f   %8.4f    %8.4f     %8.4f\n", s.length_m,
               s.translation_m.count, s.translation_percent.mean, s.translation_percent.median,
               s.rotation_deg_per_100m.mean, s.rotation_deg_per_100m.median, s.yaw_deg.mean, s.tilt_deg.mean);
  return text;
}

std::string statistics_row(const char* label, const Statistics& s) {
  return format("  %-20s %9.4f %9.4f %9.4f %9.4f %9.4f %9.4f\n", label, s.rmse, s.mean, s.median, s.deviation,
                s.min, s.max);
}

std::string pairs(const Evaluation& e) {
  const PairOptions& options = e.pair_options;
  if (e.pairs.translation_m.count == 0) return "";
  return format("relative error (evo's pairs, %s %g %s along the %s: %zu)\n",
                options.all_pairs ? "all" : "one after the other,", options.delta,
                options.unit == PairOptions::Unit::kMetres ? "m" : "rows",
                options.pairs_from_truth ? "truth" : "estimate", e.pairs.translation_m.count) +
         "                            rmse      mean    median       std       min       max\n" +
         statistics_row("translation, m", e.pairs.translation_m) +
         statistics_row("rotation, deg", e.pairs.rotation_deg) +
         statistics_row("point distance, m", e.pairs.point_distance_m);
}

std::string absolute(const Evaluation& e) {
  std::string text =
      "absolute error (ATE; evo's APE)\n"
      "  aligned by          rmse m    mean m  median m     std m     min m     max m      x m      y m      "
      "z m"
      "  turn deg\n";
  for (const AbsoluteErrors& a : e.absolute)
    text += format("  %-16s %9.4f %9.4f %9.4f %9.4f %9.4f %9.4f %8.4f %8.4f %8.4f %9.4f\n",
                   std::string(to_string(a.alignment)).c_str(), a.rmse_m, a.mean_m, a.median_m, a.deviation_m,
                   a.min_m, a.max_m, a.axis_rmse_m.x(), a.axis_rmse_m.y(), a.axis_rmse_m.z(),
                   a.rotation_rmse_rad * kDegPerRad);
  return text;
}

std::string consistency(const Evaluation& e) {
  if (!e.consistency) return "";
  const Consistency& c = *e.consistency;
  if (c.motions.empty()) return "covariance (NEES): no motion that it could be judged by\n";
  const Vector6d& r = c.error_per_sigma;
  return format("covariance (NEES: 6 when right; 95 %% of right ones within %.3f to %.3f)\n", c.lower,
                c.upper) +
         format(
             "  NEES %.3f over %zu motions, translation %.3f of 3, rotation %.3f of 3; %.1f %% below their "
             "95 %% bound\n",
             c.nees, c.motions.size(), c.translation_nees, c.rotation_nees, c.inside_percent) +
         format("  error / sigma  x %.2f  y %.2f  z %.2f  roll %.2f  pitch %.2f  yaw %.2f\n", r[0], r[1],
                r[2], r[3], r[4], r[5]);
}

std::string notes(const Evaluation& e, const char* before) {
  std::string text;
  for (const std::string& warning : e.warnings) text += before + warning + "\n";
  return text;
}

}  // namespace

std::string evaluation_report(const Evaluation& evaluation) {
  const Evaluation& e = evaluation;
  return head(e) + motion(e) + end(e.final_drift) + relative(e) + sub_trajectories(e) + pairs(e) +
         absolute(e) + consistency(e) + notes(e, "note: ");
}

}  // namespace pago::evaluation
