// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "pago/evaluation/evaluation.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

using Json = nlohmann::ordered_json;

Json axes(const Eigen::Vector3d& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

Json turns(const Eigen::Vector3d& v) {
  return {{"roll", v.x()}, {"pitch", v.y()}, {"yaw", v.z()}};
}

Json json_of(const Motion& motion) {
  return {{"path_length_m", motion.path_length_m},
          {"yaw_range_deg", motion.yaw_range_rad * kDegPerRad},
          {"furthest_m", motion.furthest_m},
          {"end_m", motion.end_m}};
}

Json json_of(const DriftRates& rates) {
  return {{"segments", rates.num_segments},
          {"t_rel_percent", rates.t_rel_percent},
          {"r_rel_deg_per_100m", rates.r_rel_deg_per_100m},
          {"axis_percent", axes(rates.axis_percent)},
          {"axis_deg_per_100m", turns(rates.axis_deg_per_100m)}};
}

Json json_of(const AbsoluteErrors& errors) {
  return {{"aligned_by", to_string(errors.alignment)},
          {"rmse_m", errors.rmse_m},
          {"mean_m", errors.mean_m},
          {"median_m", errors.median_m},
          {"max_m", errors.max_m},
          {"axis_rmse_m", axes(errors.axis_rmse_m)},
          {"rotation_rmse_deg", errors.rotation_rmse_rad * kDegPerRad},
          {"axis_rotation_rmse_deg", turns(errors.axis_rotation_rmse_rad * kDegPerRad)}};
}

Json json_of(const FinalDrift& drift) {
  return {{"distance_m", drift.distance_m},
          {"percent", drift.percent},
          {"position_m", axes(drift.position_m)},
          {"rotation_deg", drift.rotation_rad * kDegPerRad}};
}

Json relative_of(const Evaluation& e) {
  Json relative = json_of(e.relative.overall);
  relative["lengths_m"] = e.lengths_m;
  relative["step_rows"] = e.step_rows;
  relative["skipped_segments"] = e.relative.num_skipped;
  relative["by_length"] = Json::array();
  for (const DriftRates& rates : e.relative.by_length) {
    Json row = {{"length_m", rates.length_m}};
    row.update(json_of(rates));
    relative["by_length"].push_back(row);
  }
  return relative;
}

}  // namespace

std::string evaluation_json(const Evaluation& e) {
  Json json = {
      {"truth", {{"file", e.truth_name}, {"poses", e.truth_poses}, {"motion", json_of(e.truth_motion)}}},
      {"estimate",
       {{"file", e.estimate_name}, {"poses", e.estimate_poses}, {"motion", json_of(e.estimate_motion)}}},
      {"matched", {{"rows", e.num_rows}, {"with_estimate", e.num_matched}, {"how", e.how}}},
      {"relative", relative_of(e)},
      {"absolute", Json::array()},
      {"final_drift", json_of(e.final_drift)},
      {"warnings", e.warnings}};
  for (const AbsoluteErrors& errors : e.absolute) json["absolute"].push_back(json_of(errors));
  // File names need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pago::evaluation
