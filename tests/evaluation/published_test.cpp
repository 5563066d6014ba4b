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

/// What a script of its own (numpy, from the definitions in rpg_trajectory_evaluation and evo) says of the
/// same files: per length of path the number of sub-trajectories, mean and median of their translation in
/// percent, mean rotation in degrees per metre, mean yaw and tilt in degrees.
struct SubTrajectoryGolden {
  double length_m;
  std::size_t count;
  double mean_percent, median_percent, deg_per_m, yaw_deg, tilt_deg;
};

void check(const std::vector<SubTrajectoryErrors>& errors, const std::vector<SubTrajectoryGolden>& golden) {
  REQUIRE(errors.size() == golden.size());
  for (std::size_t i = 0; i < golden.size(); ++i) {
    CHECK(errors[i].length_m == Approx(golden[i].length_m));
    CHECK(errors[i].translation_m.count == golden[i].count);
    CHECK(errors[i].translation_percent.mean == Approx(golden[i].mean_percent).margin(1e-6));
    CHECK(errors[i].translation_percent.median == Approx(golden[i].median_percent).margin(1e-6));
    CHECK(errors[i].rotation_deg_per_100m.mean == Approx(100 * golden[i].deg_per_m).margin(1e-6));
    CHECK(errors[i].yaw_deg.mean == Approx(golden[i].yaw_deg).margin(1e-6));
    CHECK(errors[i].tilt_deg.mean == Approx(golden[i].tilt_deg).margin(1e-6));
  }
}

TEST_CASE("rpg's relative errors are those of an independent script", "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kitti, "kitti/results");
  check(evaluate_camera_poses(kitti / "kiss_icp_00/00_gt_kitti.txt", kitti / "kiss_icp_00/00_poses_kitti.txt")
            .sub_trajectories,
        {{372.41, 4235, 0.508046, 0.434207, 0.00160933, 0.425738, 0.347790},
         {744.83, 3992, 0.384870, 0.314797, 0.00113484, 0.660282, 0.438822},
         {1117.25, 3637, 0.359072, 0.313955, 0.00099336, 0.923250, 0.540097},
         {1489.67, 3244, 0.332696, 0.296454, 0.00091598, 1.190555, 0.612009},
         {1862.09, 2924, 0.319700, 0.305042, 0.00086867, 1.427866, 0.728099}});
  check(evaluate_camera_poses(kitti / "../poses/05.txt", kitti / "simple_online/05.txt").sub_trajectories,
        {{220.55, 2595, 0.388353, 0.373916, 0.00309380, 0.210731, 0.608327},
         {441.11, 2429, 0.287905, 0.273525, 0.00240625, 0.309240, 0.934168},
         {661.67, 2152, 0.269514, 0.253703, 0.00216011, 0.420113, 1.262758},
         {882.23, 1947, 0.381255, 0.324582, 0.00203226, 0.574395, 1.574688},
         {1102.78, 1725, 0.464769, 0.344893, 0.00191899, 0.688417, 1.933203}});
}

TEST_CASE("evo's relative and absolute errors are those of an independent script",
          "[evaluation][published]") {
  PAGO_DATA_OR_SKIP(kiss, "kitti/results/kiss_icp_00");
  const Trajectory truth = read_trajectory(kiss / "00_gt_kitti.txt");
  const Trajectory estimate = read_trajectory(kiss / "00_poses_kitti.txt");
  const MatchedTrajectories matched = match(truth, estimate, {});
  struct Golden {
    PairOptions options;
    std::size_t count;
    double rmse_m, mean_m, median_m, std_m, min_m, max_m, rotation_rmse_deg, point_distance_rmse_m;
  };
  const std::vector<Golden> goldens{{{},
                                     36,
                                     1.0120438908,
                                     0.8603592765,
                                     0.6970412557,
                                     0.5329303446,
                                     0.1168440017,
                                     2.8447074561,
                                     0.6952251905,
                                     0.2874320040},
                                    {{.pairs_from_truth = true},
                                     36,
                                     1.0057225679,
                                     0.8668065243,
                                     0.7607050882,
                                     0.5100238554,
                                     0.1422004930,
                                     2.5925873261,
                                     0.6115530953,
                                     0.2808480382},
                                    {{.all_pairs = true},
                                     4458,
                                     1.0735603690,
                                     0.8029499724,
                                     0.6878756928,
                                     0.7126031208,
                                     0.0337142660,
                                     11.4298032905,
                                     0.7614811806,
                                     0.2984732823},
                                    {{.unit = PairOptions::Unit::kRows, .delta = 1},
                                     4540,
                                     0.0341882432,
                                     0.0267899334,
                                     0.0224465806,
                                     0.0212399492,
                                     0.0010666941,
                                     0.3167316059,
                                     0.1367924168,
                                     0.0235004091},
                                    {{.unit = PairOptions::Unit::kRows, .delta = 10},
                                     454,
                                     0.1769054309,
                                     0.1210431324,
                                     0.0907161338,
                                     0.1290119822,
                                     0.0124929337,
                                     1.0995445141,
                                     0.6403395786,
                                     0.1092159121}};
  for (const Golden& golden : goldens) {
    const PairErrors errors = pair_errors(matched, golden.options);
    CHECK(errors.translation_m.count == golden.count);
    CHECK(errors.translation_m.rmse == Approx(golden.rmse_m).epsilon(1e-7));
    CHECK(errors.translation_m.mean == Approx(golden.mean_m).epsilon(1e-7));
    CHECK(errors.translation_m.median == Approx(golden.median_m).epsilon(1e-7));
    CHECK(errors.translation_m.deviation == Approx(golden.std_m).epsilon(1e-7));
    CHECK(errors.translation_m.min == Approx(golden.min_m).epsilon(1e-6));
    CHECK(errors.translation_m.max == Approx(golden.max_m).epsilon(1e-7));
    CHECK(errors.rotation_deg.rmse == Approx(golden.rotation_rmse_deg).epsilon(1e-6));
    CHECK(errors.point_distance_m.rmse == Approx(golden.point_distance_rmse_m).epsilon(1e-7));
  }
  const AbsoluteErrors ape = absolute_errors(matched, Alignment::kSe3);
  CHECK(ape.rmse_m == Approx(3.5007185250).epsilon(1e-8));
  CHECK(ape.mean_m == Approx(3.0172110891).epsilon(1e-8));
  CHECK(ape.median_m == Approx(2.5316252394).epsilon(1e-8));
  CHECK(ape.deviation_m == Approx(1.7752372898).epsilon(1e-8));
  CHECK(ape.min_m == Approx(0.8497270795).epsilon(1e-8));
  CHECK(ape.max_m == Approx(9.6797089828).epsilon(1e-8));
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
  EvaluationOptions options;  // the nearest of the dense poses would be centimetres off
  options.segments.lengths_m = {50, 100};
  const Evaluation e = evaluate(dense, sweeps, options);
  CHECK(e.num_matched == sweeps.poses.size());
  CHECK(e.how == "by stamp within 0.020 s, truth interpolated");
  CHECK(e.ate(Alignment::kNone).rmse_m < 1e-3);
}

}  // namespace
