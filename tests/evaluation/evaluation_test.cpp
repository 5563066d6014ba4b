// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/evaluation.hpp"

#include <nlohmann/json.hpp>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;
using Catch::Matchers::Contains;

EvaluationOptions short_lengths() {
  EvaluationOptions options;
  options.segments.lengths_m = {50, 100};
  return options;
}

TEST_CASE("a report has every figure with its unit", "[evaluation][report]") {
  const Trajectory truth = winding(1, 300, "truth.txt");
  const Evaluation e = evaluate(truth, drifting(truth, 2), short_lengths());
  const std::string report = evaluation_report(e);
  for (const char* words :
       {"truth.txt (301 poses)", "301 of 301 rows, by row", "translation, % of the length",
        "rotation, deg/100 m", "SE(3)", "yaw and position", "first pose", "none", "rmse m", "yaw range",
        "end       off by"})
    CHECK_THAT(report, Contains(words));
  CHECK(report.find("deg/m") == std::string::npos);
  for (std::size_t at = 0; at < report.size(); at = report.find('\n', at) + 1)
    CHECK(report.find('\n', at) - at <= 120);
}

TEST_CASE("the JSON form holds the same figures", "[evaluation][report]") {
  const Trajectory truth = winding(1, 300, "truth.txt");
  const Evaluation e = evaluate(truth, drifting(truth, 2), short_lengths());
  const auto json = nlohmann::json::parse(evaluation_json(e));
  CHECK(json["relative"]["t_rel_percent"] == e.relative.overall.t_rel_percent);
  CHECK(json["relative"]["r_rel_deg_per_100m"] == e.relative.overall.r_rel_deg_per_100m);
  CHECK(json["relative"]["by_length"].size() == 2);
  CHECK(json["relative"]["by_length"][1]["length_m"] == 100.0);
  CHECK(json["absolute"][0]["aligned_by"] == "SE(3)");
  CHECK(json["absolute"][0]["rmse_m"] == e.ate(Alignment::kSe3).rmse_m);
  CHECK(json["truth"]["motion"]["path_length_m"] == e.truth_motion.path_length_m);
  CHECK(json["final_drift"]["position_m"]["z"] == e.final_drift.position_m.z());
  CHECK(json["warnings"].empty());
}

TEST_CASE("one degree per metre reads 100 deg/100 m and nothing else", "[evaluation][report]") {
  const Trajectory truth = chain(planar(1, 0, 0), 60, "truth");
  EvaluationOptions options;
  options.segments.lengths_m = {50};
  const Evaluation e = evaluate(truth, chain(planar(1, 0, 3.14159265358979 / 180), 60, "estimate"), options);
  CHECK(e.relative.overall.r_rel_deg_per_100m == Approx(100.0 * 51 / 50));
  CHECK_THAT(evaluation_report(e), Contains("102.0000"));
  const auto json = nlohmann::json::parse(evaluation_json(e));
  CHECK(json["relative"]["r_rel_deg_per_100m"].get<double>() == Approx(102));
  CHECK(json["relative"].dump().find("deg_per_m") == std::string::npos);
}

TEST_CASE("a short path is scored by ATE and told which lengths to choose", "[evaluation][report]") {
  const Trajectory truth = chain(planar(1, 0, 0), 70, "truth");
  const Evaluation e = evaluate(truth, truth);
  REQUIRE(e.warnings.size() == 1);
  CHECK_THAT(e.warnings[0], Contains("70.0 m is not longer than the shortest length, 100 m"));
  CHECK_THAT(evaluation_report(e),
             Contains("note: No relative error") && !Contains("t_rel") && !Contains("nan"));
  CHECK(nlohmann::json::parse(evaluation_json(e))["relative"]["t_rel_percent"].is_null());
}

TEST_CASE("a truth that stands still gives no percentages of its path", "[evaluation][report]") {
  const Trajectory truth = chain(Eigen::Isometry3d::Identity(), 70, "truth");
  const std::string report = evaluation_report(evaluate(truth, chain(planar(0.001, 0, 0), 70, "estimate")));
  CHECK_THAT(report, Contains("path      0.07 m, true 0.00 m\n") && Contains("off by 0.070 m (x +0.070"));
  CHECK_THAT(report, !Contains("nan") && !Contains("inf"));
}

TEST_CASE("missing estimates are reported", "[evaluation][report]") {
  Trajectory truth = winding(1, 300, "truth");
  stamp(truth, 0, 100'000'000);
  Trajectory estimate = drifting(truth, 2);
  stamp(estimate, 0, 100'000'000);
  estimate.poses.erase(estimate.poses.begin() + 100, estimate.poses.begin() + 110);
  const Evaluation e = evaluate(truth, estimate, short_lengths());
  CHECK(e.num_rows == 301);
  CHECK(e.num_matched == 291);
  REQUIRE(e.warnings.size() == 1);
  CHECK_THAT(e.warnings[0], Contains("10 of 301 rows have no estimate"));
}

TEST_CASE("camera poses are scored against sensor poses with the calibration only", "[evaluation][report]") {
  const Trajectory sensor = winding(1, 300, "sensor.txt");
  Eigen::Isometry3d T_camera_sensor = T_camera_sensor_axes();
  T_camera_sensor.translation() = Eigen::Vector3d(0.1, -0.5, -0.2);
  Trajectory camera = sensor;
  camera.name = "camera.txt";
  camera_to_sensor(camera, T_camera_sensor.inverse());

  EvaluationOptions options = short_lengths();
  options.truth_frame = PoseFrame::kCamera;
  CHECK_THROWS_WITH(evaluate(camera, sensor, options), Contains("camera.txt: holds poses of the camera"));
  options.T_camera_sensor = T_camera_sensor;
  const Evaluation e = evaluate(camera, sensor, options);
  CHECK(e.ate(Alignment::kNone).rmse_m < 1e-9);
  CHECK(e.relative.overall.t_rel_percent < 1e-9);
}

TEST_CASE("final drift is the end's offset in the first pose's frame", "[evaluation][report]") {
  std::mt19937 random(1);
  const auto T = random_motion(random, 10, 1), T_other = random_motion(random, 10, 1);
  const Trajectory truth = moved(T, chain(planar(1, 0, 0), 200, "truth"));
  const Trajectory estimate = moved(T_other, chain(planar(1.01, 0, 0), 200, "estimate"));
  const FinalDrift drift = evaluate(truth, estimate).final_drift;
  CHECK((drift.position_m - Eigen::Vector3d(2, 0, 0)).norm() < 1e-9);
  CHECK(drift.percent == Approx(1.0));
  CHECK(drift.rotation_rad < 1e-9);
}

TEST_CASE("rows chosen where the estimate has nothing are refused", "[evaluation][report]") {
  Trajectory truth = winding(1, 100, "truth"), estimate = truth;
  stamp(truth, 0, 100'000'000);
  stamp(estimate, 0, 100'000'000);
  estimate.name = "estimate";
  estimate.poses.resize(50);
  EvaluationOptions options = short_lengths();
  options.match.rows = RowRange{60, 90};
  CHECK_THROWS_AS(evaluate(truth, estimate, options), pago::Error);
}

TEST_CASE("the figures of rpg, evo and the covariance are in both reports", "[evaluation][report]") {
  const Trajectory truth = town_drive(300, "truth.txt");
  Trajectory estimate = drifting(truth, 2);
  estimate.motion_covariances.assign(300, pago::Matrix6d::Identity() * 1e-4);
  const Evaluation e = evaluate(truth, estimate, short_lengths());
  REQUIRE(e.consistency);
  const std::string report = evaluation_report(e);
  for (const char* words :
       {"rpg's sub-trajectories", "tilt, deg", "evo's pairs, one after the other, 100 m along",
        "point distance, m", "NEES: 6 when right", "error / sigma  x "})
    CHECK_THAT(report, Contains(words));
  const auto json = nlohmann::json::parse(evaluation_json(e));
  CHECK(json["sub_trajectories"].size() == 5);
  CHECK(json["sub_trajectories"][2]["translation_percent"]["mean"] ==
        e.sub_trajectories[2].translation_percent.mean);
  CHECK(json["pairs"]["translation_m"]["rmse"] == e.pairs.translation_m.rmse);
  CHECK(json["pairs"]["delta_m"] == 100.0);
  CHECK(json["covariance"]["nees"] == e.consistency->nees);
  CHECK(json["relative"]["by_speed"].size() == e.relative.by_speed.size());
  CHECK(json["absolute"][0]["std_m"] == e.absolute[0].deviation_m);
  CHECK(json["mix_ups"].empty());
  estimate.motion_covariances.clear();
  const Evaluation without = evaluate(truth, estimate, short_lengths());
  CHECK(nlohmann::json::parse(evaluation_json(without))["covariance"].is_null());
  CHECK_THAT(evaluation_report(without), !Contains("NEES"));
}

TEST_CASE("truth of the body that carries the sensor is brought to the sensor", "[evaluation][report]") {
  const Trajectory sensor = town_drive(300, "sensor.txt");
  Eigen::Isometry3d T_body_sensor = planar(1.2, -0.3, 0.5);
  T_body_sensor.translation().z() = 1.7;
  Trajectory body = sensor;
  body_to_sensor(body, T_body_sensor.inverse());
  CHECK(evaluate(body, sensor, short_lengths()).mix_ups.size() > 0);
  EvaluationOptions options = short_lengths();
  options.T_truth_sensor = T_body_sensor;
  const Evaluation e = evaluate(body, sensor, options);
  CHECK(e.ate(Alignment::kNone).rmse_m < 1e-9);
  CHECK(e.mix_ups.empty());
  options.truth_frame = PoseFrame::kCamera;
  options.T_camera_sensor = T_camera_sensor_axes();
  CHECK_THROWS_WITH(evaluate(body, sensor, options), Contains("camera and of another body"));
}

TEST_CASE("a mix-up is a warning with its evidence", "[evaluation][report]") {
  const Trajectory truth = town_drive(300, "truth.txt");
  Trajectory camera = truth;
  camera_to_sensor(camera, T_camera_sensor_axes().inverse());
  const Evaluation e = evaluate(truth, camera, short_lengths());
  REQUIRE(e.warnings.size() == 1);
  CHECK_THAT(e.warnings[0], Contains("The estimate seems to hold poses of KITTI's camera") &&
                                Contains("% less") && Contains("--estimate-frame camera"));
  CHECK_THAT(evaluation_report(e), Contains("note: The estimate seems"));
  CHECK(nlohmann::json::parse(evaluation_json(e))["mix_ups"].size() == 1);
}

}  // namespace
