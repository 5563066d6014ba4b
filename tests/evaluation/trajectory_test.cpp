// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/trajectory.hpp"

#include <unistd.h>

#include <fstream>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using Catch::Matchers::Contains;

const std::string kIdentity = "1 0 0 0 0 1 0 0 0 0 1 0\n";

TEST_CASE("twelve columns are KITTI's", "[evaluation][trajectory]") {
  const Trajectory t = parse_trajectory(kIdentity + "0 -1 0 1.5\t1 0 0 -2e0 0 0 1 +3\r\n", "t.txt");
  REQUIRE(t.poses.size() == 2);
  CHECK_FALSE(t.has_stamps());
  CHECK(t.poses[1].row == 1);
  CHECK(t.poses[1].T_world_sensor.translation() == Eigen::Vector3d(1.5, -2, 3));
  CHECK((t.poses[1].T_world_sensor.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm() <
        1e-15);
}

TEST_CASE("eight columns are TUM's, with stamps exact to the nanosecond", "[evaluation][trajectory]") {
  const Trajectory t = parse_trajectory(
      "# stamp x y z qx qy qz qw\n\n"
      "1317378034.123456789 1 2 3 0 0 0 1\n"
      "  1.317378035e9 4 5 6 0 0 0.70710678 0.70710678",
      "t.tum");
  REQUIRE(t.poses.size() == 2);
  CHECK(t.poses[0].stamp_ns == 1'317'378'034'123'456'789);
  CHECK(t.poses[1].stamp_ns == 1'317'378'035'000'000'000);
  CHECK(t.poses[1].T_world_sensor.translation() == Eigen::Vector3d(4, 5, 6));
  CHECK((t.poses[1].T_world_sensor.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm() <
        1e-7);
}

TEST_CASE("rounded rotations are made orthonormal, others are refused", "[evaluation][trajectory]") {
  const Trajectory t = parse_trajectory("0.999 -0.0447 0 0 0.0447 0.999 0 0 0 0 1 0\n", "t.txt");
  const Eigen::Matrix3d R = t.poses[0].T_world_sensor.linear();
  CHECK((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  for (const char* row : {"1.1 0 0 0 0 1 0 0 0 0 1 0", "1 0 0 0 0 1 0 0 0 0 -1 0", "0 0 0 0 0 0 0 0 0 0 0 0"})
    CHECK_THROWS_WITH(parse_trajectory(kIdentity + row, "t.txt"),
                      Contains("t.txt:2: ") && Contains("not a rotation"));
  CHECK_THROWS_WITH(parse_trajectory("1 0 0 0 0 0 0 0.9", "t.tum"), Contains("t.tum:1: the quaternion"));
  CHECK_THROWS_WITH(parse_trajectory("1 0 0 0 0 0 0 0", "t.tum"), Contains("t.tum:1: the quaternion"));
}

TEST_CASE("what is no trajectory is refused by file and line", "[evaluation][trajectory]") {
  const auto refusal = [](const std::string& text) {
    try {
      parse_trajectory(text, "t.txt");
    } catch (const pago::Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal(""), Contains("t.txt: holds no pose"));
  CHECK_THAT(refusal("# only a comment\n\n"), Contains("t.txt: holds no pose"));
  CHECK_THAT(refusal("1 2 3 4 5 6 7\n"), Contains("t.txt:1: has 7 numbers (a pose has 12 (KITTI) or 8"));
  CHECK_THAT(refusal(kIdentity + "\n" + "0 0 0 0 0 0 0 1\n"),
             Contains("t.txt:3: has 8 numbers, the first pose has 12"));
  CHECK_THAT(refusal(kIdentity + "1 0 0 nan 0 1 0 0 0 0 1 0"),
             Contains("t.txt:2: \"nan\" is not a finite number"));
  CHECK_THAT(refusal(kIdentity + "1 0 0 inf 0 1 0 0 0 0 1 0"), Contains("is not a finite number"));
  CHECK_THAT(refusal("1 0 0 x 0 1 0 0 0 0 1 0"), Contains("t.txt:1: \"x\" is not a number"));
  CHECK_THAT(refusal("1 0 0 1e999 0 1 0 0 0 0 1 0"), Contains("is not a number"));
  CHECK_THAT(refusal("1,0,0,0,0,1,0,0,0,0,1,0"), Contains("is not a number"));
  CHECK_THAT(refusal("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), Contains("t.txt:2: its stamp is not later"));
  CHECK_THAT(refusal("1317378034500000000 0 0 0 0 0 0 1\n"),
             Contains("t.txt:1: its stamp is too large for seconds"));
  CHECK_THAT(refusal(std::string("\0\xff\x80 binary", 10)), Contains("t.txt:1: "));
}

TEST_CASE("a missing file and a folder are refused by name", "[evaluation][trajectory]") {
  CHECK_THROWS_WITH(read_trajectory("no/such/file.txt"), Contains("no/such/file.txt: cannot be opened"));
  CHECK_THROWS_WITH(read_trajectory(std::filesystem::temp_directory_path()), Contains("is a folder"));
}

/// A file in the temporary folder for the time of a test.
struct ScratchFile {
  explicit ScratchFile(const std::string& text)
      : path(std::filesystem::temp_directory_path() / ("pago_trajectory_" + std::to_string(::getpid()))) {
    std::ofstream(path) << text;
  }
  ~ScratchFile() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

TEST_CASE("a times file stamps KITTI rows", "[evaluation][trajectory]") {
  Trajectory t = parse_trajectory(kIdentity + kIdentity, "t.txt");
  attach_times(t, ScratchFile("0.000000e+00\n1.036224e-01\n").path);
  CHECK(t.has_stamps());
  CHECK(t.poses[1].stamp_ns == 103'622'400);
  CHECK_THROWS_WITH(attach_times(t, ScratchFile("0\n1\n").path), Contains("t.txt: has stamps of its own"));
  t = parse_trajectory(kIdentity + kIdentity, "t.txt");
  CHECK_THROWS_WITH(attach_times(t, ScratchFile("0\n").path), Contains("has 1 times, t.txt has 2 poses"));
  t = parse_trajectory(kIdentity + kIdentity, "t.txt");
  CHECK_THROWS_WITH(attach_times(t, ScratchFile("0\n1 2\n").path), Contains(":2: is not one number"));
  t = parse_trajectory(kIdentity + kIdentity, "t.txt");
  CHECK_THROWS_WITH(attach_times(t, ScratchFile("1\n1\n").path), Contains(":2: is not later"));
}

TEST_CASE("the calibration is the line Tr of calib.txt", "[evaluation][trajectory]") {
  const ScratchFile file("P0: 7 0 6 0 0 7 1 0 0 0 1 0\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n");
  const Eigen::Isometry3d T = read_kitti_calibration(file.path);
  CHECK((T.linear() - T_camera_sensor_axes().linear()).norm() < 1e-15);
  CHECK(T.translation() == Eigen::Vector3d(0.1, 0.2, 0.3));
  CHECK_THROWS_WITH(read_kitti_calibration(ScratchFile("P0: 1\n").path), Contains("has no line \"Tr: ...\""));
  CHECK_THROWS_WITH(read_kitti_calibration(ScratchFile("Tr: 1 2 3\n").path), Contains("not followed by 12"));
}

TEST_CASE("driving forward at the camera is driving forward at the sensor", "[evaluation][trajectory]") {
  // Camera: z forward, y down. The sensor rides 0.5 m above and 0.2 m behind the camera.
  Eigen::Isometry3d T_camera_sensor = T_camera_sensor_axes();
  T_camera_sensor.translation() = Eigen::Vector3d(0, -0.5, -0.2);
  Eigen::Isometry3d left_turn = Eigen::Isometry3d::Identity();
  left_turn.translation().z() = 2.0;
  left_turn.rotate(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY()));
  Trajectory t = pago::test::trajectory_of({Eigen::Isometry3d::Identity(), left_turn}, "t");
  camera_to_sensor(t, T_camera_sensor);
  CHECK(t.poses[0].T_world_sensor.isApprox(Eigen::Isometry3d::Identity()));
  const Eigen::Isometry3d expected =
      pago::test::planar(2.0 + 0.2 - 0.2 * std::cos(0.1), -0.2 * std::sin(0.1), 0.1);
  CHECK((t.poses[1].T_world_sensor.matrix() - expected.matrix()).norm() < 1e-12);
}

}  // namespace
