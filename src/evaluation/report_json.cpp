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
          {"std_m", errors.deviation_m},
          {"min_m", errors.min_m},
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

Json json_of(const Statistics& s) {
  return {{"count", s.count},   {"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median},
          {"std", s.deviation}, {"min", s.min},   {"max", s.max}};
}

Json json_of(const SubTrajectoryErrors& errors) {
  return {{"length_m", errors.length_m},
          {"translation_m", json_of(errors.translation_m)},
          {"translation_percent", json_of(errors.translation_percent)},
          {"rotation_deg", json_of(errors.rotation_deg)},
          {"rotation_deg_per_100m", json_of(errors.rotation_deg_per_100m)},
          {"yaw_deg", json_of(errors.yaw_deg)},
          {"tilt_deg", json_of(errors.tilt_deg)}};
}

Json pairs_of(const Evaluation& e) {
  const PairOptions& options = e.pair_options;
  return {{options.unit == PairOptions::Unit::kMetres ? "delta_m" : "delta_rows", options.delta},
          {"all_pairs", options.all_pairs},
          {"along", options.pairs_from_truth ? "truth" : "estimate"},
          {"translation_m", json_of(e.pairs.translation_m)},
          {"rotation_deg", json_of(e.pairs.rotation_deg)},
          {"point_distance_m", json_of(e.pairs.point_distance_m)}};
}

Json json_of(const Consistency& c) {
  const Vector6d& r = c.error_per_sigma;
  return {{"motions", c.motions.size()},
          {"unusable", c.num_unusable},
          {"nees", c.nees},
          {"lower_95", c.lower},
          {"upper_95", c.upper},
          {"translation_nees", c.translation_nees},
          {"rotation_nees", c.rotation_nees},
          {"inside_95_percent", c.inside_percent},
          {"error_per_sigma",
           {{"x", r[0]}, {"y", r[1]}, {"z", r[2]}, {"roll", r[3]}, {"pitch", r[4]}, {"yaw", r[5]}}}};
}

Json json_of(const MixUp& mix_up) {
  return {{"finding", mix_up.finding}, {"evidence", mix_up.evidence}, {"remedy", mix_up.remedy}};
}

template <typename Item>
Json list_of(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
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
  relative["by_speed"] = Json::array();
  for (const DriftRates& rates : e.relative.by_speed) {
    Json row = {{"speed_m_per_s", rates.speed_m_per_s}};
    row.update(json_of(rates));
    relative["by_speed"].push_back(row);
  }
  return relative;
}

Json json_of(const Evaluation& e) {
  Json json = {
      {"truth", {{"file", e.truth_name}, {"poses", e.truth_poses}, {"motion", json_of(e.truth_motion)}}},
      {"estimate",
       {{"file", e.estimate_name}, {"poses", e.estimate_poses}, {"motion", json_of(e.estimate_motion)}}},
      {"matched", {{"rows", e.num_rows}, {"with_estimate", e.num_matched}, {"how", e.how}}},
      {"relative", relative_of(e)},
      {"sub_trajectories", list_of(e.sub_trajectories)},
      {"pairs", pairs_of(e)},
      {"absolute", Json::array()},
      {"final_drift", json_of(e.final_drift)},
      {"covariance", e.consistency ? json_of(*e.consistency) : Json()},
      {"mix_ups", list_of(e.mix_ups)},
      {"warnings", e.warnings}};
  for (const AbsoluteErrors& errors : e.absolute) json["absolute"].push_back(json_of(errors));
  return json;
}

/// File names need not be UTF-8.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string evaluation_json(const Evaluation& evaluation) {
  return text_of(json_of(evaluation));
}

std::string evaluations_json(const std::vector<Evaluation>& evaluations) {
  Json list = Json::array();
  for (const Evaluation& evaluation : evaluations) list.push_back(json_of(evaluation));
  return text_of({{"evaluations", list}});
}

}  // namespace pago::evaluation
