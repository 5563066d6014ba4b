// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "pago/evaluation/evaluation.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

namespace {

using namespace pago::evaluation;

/// SiMpLE's own table (t_rel in percent, sequences 00 to 10).
constexpr std::array kSimple{.6667, .7749, .6263, .7369, .4067, .3372, .2613, .4706, .8236, .5684, .6454};

Evaluation evaluate_camera_poses(const std::filesystem::path& truth, const std::filesystem::path& estimate) {
  EvaluationOptions options;
  options.truth_frame = options.estimate_frame = PoseFrame::kCamera;
  return evaluate(read_trajectory(truth), read_trajectory(estimate), options);
}

TEST_CASE("t_rel of SiMpLE's trajectories is the published one on all eleven KITTI sequences",
          "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kitti, "kitti/results/simple_online");
  for (std::size_t sequence = 0; sequence < kSimple.size(); ++sequence) {
    std::string name = "00.txt";
    name[0] = static_cast<char>('0' + sequence / 10);
    name[1] = static_cast<char>('0' + sequence % 10);
    const Evaluation e = evaluate_camera_poses(kitti / "../../poses" / name, kitti / name);
    INFO(name);
    CHECK(e.relative.overall.t_rel_percent == Approx(kSimple[sequence]).epsilon(0).margin(0.5e-4));
    CHECK(e.num_matched == e.truth_poses);
  }
}

TEST_CASE("KISS-ICP's errors on KITTI 00 are those of its own log", "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kiss, "kitti/results/kiss_icp_00");
  const Evaluation e = evaluate_camera_poses(kiss / "00_gt_kitti.txt", kiss / "00_poses_kitti.txt");
  CHECK(e.relative.overall.t_rel_percent == Approx(0.528).epsilon(0).margin(0.5e-3));
  CHECK(e.ate(Alignment::kSe3).rmse_m == Approx(3.501).epsilon(0).margin(0.5e-3));
  CHECK(e.ate(Alignment::kSe3).rotation_rmse_rad == Approx(0.019).epsilon(0).margin(0.5e-3));
  // The log says 0.002 deg/m.
  CHECK(e.relative.overall.r_rel_deg_per_100m / 100.0 == Approx(0.002).epsilon(0).margin(0.5e-3));
}

TEST_CASE("the ATE does not depend on the file format", "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kiss, "kitti/results/kiss_icp_00");
  const Evaluation kitti = evaluate_camera_poses(kiss / "00_gt_kitti.txt", kiss / "00_poses_kitti.txt");
  const Evaluation tum = evaluate_camera_poses(kiss / "00_gt_tum.txt", kiss / "00_poses_tum.txt");
  CHECK(kitti.how == "by row");
  CHECK(tum.how == "by stamp within 0.020 s");
  // The TUM files have four decimals.
  CHECK(tum.ate(Alignment::kSe3).rmse_m == Approx(kitti.ate(Alignment::kSe3).rmse_m).margin(2e-4));
  CHECK(tum.relative.overall.t_rel_percent == Approx(kitti.relative.overall.t_rel_percent).margin(5e-3));
}

TEST_CASE("errors at the camera and at the sensor tell the same of KITTI 00", "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kiss, "kitti/results/kiss_icp_00");
  const auto calibration = kiss / "../../odometry_00_000000-000015/calib.txt";
  EvaluationOptions options;
  options.truth_frame = options.estimate_frame = PoseFrame::kCamera;
  options.T_camera_sensor = read_kitti_calibration(calibration);
  const Evaluation e = evaluate(read_trajectory(kiss / "00_gt_kitti.txt"),
                                read_trajectory(kiss / "00_poses_kitti.txt"), options);
  // The sensor rides 0.3 m from the camera: rotation errors move it a little, turning rates stay.
  CHECK(e.relative.overall.t_rel_percent == Approx(0.528).margin(0.005));
  CHECK(e.relative.overall.r_rel_deg_per_100m == Approx(0.1886).margin(1e-3));
  CHECK(e.ate(Alignment::kSe3).rmse_m == Approx(3.501).margin(0.01));
  CHECK(e.truth_motion.path_length_m == Approx(3724).margin(5));
}

TEST_CASE("KITTI's camera poses become the sensor poses of its LiDAR file", "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/odometry_00_000000-000015");
  Trajectory camera = read_trajectory(folder / "poses_cam0.txt");
  camera_to_sensor(camera, read_kitti_calibration(folder / "calib.txt"));
  const Trajectory sensor = read_trajectory(folder / "poses.txt");
  REQUIRE(camera.poses.size() == sensor.poses.size());
  for (std::size_t i = 0; i < sensor.poses.size(); ++i)
    CHECK((camera.poses[i].T_world_sensor.matrix() - sensor.poses[i].T_world_sensor.matrix()).norm() < 1e-5);
}

TEST_CASE("the city drive's truth is as long and turns as far as its description says",
          "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(file, "packets/drive_0005/poses_planar_vel.txt");
  const Trajectory truth = read_trajectory(file);
  EvaluationOptions options;
  options.match.rows = parse_row_range("0-152");
  const Evaluation e = evaluate(truth, truth, options);
  CHECK(e.truth_motion.path_length_m == Approx(70.5).margin(0.05));
  CHECK(e.truth_motion.yaw_range_rad * 57.29577951 == Approx(75.3).margin(0.05));
}

TEST_CASE("a 200 Hz truth interpolated at the sweeps' stamps gives the truth per sweep",
          "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(folder, "packets/lab_urban");
  const Trajectory dense = read_trajectory(folder / "truth_200hz.tum");
  Trajectory sweeps = read_trajectory(folder / "poses_mid.txt");
  std::ifstream times(folder / "times_start_mid_end.txt");
  for (StampedPose& pose : sweeps.poses) {
    long double start_s = 0, mid_s = 0, end_s = 0;
    REQUIRE(times >> start_s >> mid_s >> end_s);
    pose.stamp_ns = std::llround(mid_s * 1e9L);
  }
  EvaluationOptions options;
  options.match.interpolates_truth = true;
  options.segments.lengths_m = {50, 100};
  const Evaluation e = evaluate(dense, sweeps, options);
  CHECK(e.num_matched == sweeps.poses.size());
  CHECK(e.how == "by stamp within 0.020 s, truth interpolated");
  CHECK(e.ate(Alignment::kNone).rmse_m < 1e-3);
  // Interpolation matters: the nearest of the dense poses is centimetres off.
  options.match.interpolates_truth = false;
  CHECK(evaluate(dense, sweeps, options).ate(Alignment::kNone).rmse_m > 5e-3);
}

}  // namespace
