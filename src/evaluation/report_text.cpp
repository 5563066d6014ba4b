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

std::string absolute(const Evaluation& e) {
  std::string text =
      "absolute error (ATE)\n"
      "  aligned by           rmse m    mean m  median m     max m     x m      y m      z m  rotation deg\n";
  for (const AbsoluteErrors& a : e.absolute)
    text += format("  %-16s %10.4f %9.4f %9.4f %9.4f %8.4f %8.4f %8.4f  %12.4f\n",
                   std::string(to_string(a.alignment)).c_str(), a.rmse_m, a.mean_m, a.median_m, a.max_m,
                   a.axis_rmse_m.x(), a.axis_rmse_m.y(), a.axis_rmse_m.z(), a.rotation_rmse_rad * kDegPerRad);
  return text;
}

}  // namespace

std::string evaluation_report(const Evaluation& evaluation) {
  const Evaluation& e = evaluation;
  std::string text = head(e) + motion(e) + end(e.final_drift) + relative(e) + absolute(e);
  for (const std::string& warning : e.warnings) text += "note: " + warning + "\n";
  return text;
}

}  // namespace pago::evaluation
