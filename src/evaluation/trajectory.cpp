// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/trajectory.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "number_rows.hpp"
#include "pago/core/error.hpp"

namespace pago::evaluation {
namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
// Files with four decimals are off by a few 1e-4; what is off by more is not a rounded rotation.
constexpr double kRotationTolerance = 5e-3;

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R, const std::string& where) {
  const double excess = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(excess <= kRotationTolerance) || R.determinant() < 0.0)
    throw Error(where, "the first three columns of the 3 x 4 matrix are not a rotation");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::Isometry3d pose_of_kitti(const double* numbers, const std::string& where) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(numbers);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = nearest_rotation(rows.leftCols<3>(), where);
  T.translation() = rows.col(3);
  return T;
}

Eigen::Isometry3d pose_of_tum(const double* numbers, const std::string& where) {
  const Eigen::Quaterniond q(numbers[7], numbers[4], numbers[5], numbers[6]);
  if (!(std::abs(q.norm() - 1.0) <= kRotationTolerance))
    throw Error(where, "the quaternion qx qy qz qw has not length 1");
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(numbers[1], numbers[2], numbers[3]);
  return T;
}

void check_columns(const NumberRow& row, std::size_t first_columns, const std::string& where) {
  const std::size_t columns = row.numbers.size();
  if (columns != kKittiColumns && columns != kTumColumns)
    throw Error(where, "has " + std::to_string(columns) + " numbers",
                "a pose has 12 (KITTI) or 8 (TUM: stamp x y z qx qy qz qw)");
  if (columns != first_columns)
    throw Error(where, "has " + std::to_string(columns) + " numbers, the first pose has " +
                           std::to_string(first_columns));
}

StampedPose to_pose(const NumberRow& row, const std::string& where) {
  StampedPose pose;
  if (row.numbers.size() == kKittiColumns) {
    pose.T_world_sensor = pose_of_kitti(row.numbers.data(), where);
  } else {
    pose.stamp_ns = stamp_ns(row, where);
    pose.T_world_sensor = pose_of_tum(row.numbers.data(), where);
  }
  return pose;
}

void append(Trajectory& trajectory, StampedPose pose, const std::string& where) {
  auto& poses = trajectory.poses;
  if (pose.stamp_ns && !poses.empty() && *pose.stamp_ns <= *poses.back().stamp_ns)
    throw Error(where, "its stamp is not later than the one before");
  pose.row = poses.size();
  poses.push_back(pose);
}

}  // namespace

Trajectory parse_trajectory(std::string_view text, const std::string& name) {
  const std::vector<NumberRow> rows = parse_number_rows(text, name);
  if (rows.empty()) throw Error(name, "holds no pose");
  Trajectory trajectory{.name = name, .poses = {}};
  for (const NumberRow& row : rows) {
    const std::string where = at_line(name, row.line);
    check_columns(row, rows.front().numbers.size(), where);
    append(trajectory, to_pose(row, where), where);
  }
  return trajectory;
}

Trajectory read_trajectory(const std::filesystem::path& file) {
  return parse_trajectory(read_text(file), file.string());
}

void attach_times(Trajectory& trajectory, const std::filesystem::path& times_file) {
  const std::string name = times_file.string();
  if (trajectory.has_stamps()) throw Error(trajectory.name, "has stamps of its own", "leave out " + name);
  const std::vector<NumberRow> rows = parse_number_rows(read_text(times_file), name);
  if (rows.size() != trajectory.poses.size())
    throw Error(name, "has " + std::to_string(rows.size()) + " times, " + trajectory.name + " has " +
                          std::to_string(trajectory.poses.size()) + " poses");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string where = at_line(name, rows[i].line);
    if (rows[i].numbers.size() != 1) throw Error(where, "is not one number in seconds");
    trajectory.poses[i].stamp_ns = stamp_ns(rows[i], where);
    if (i > 0 && *trajectory.poses[i].stamp_ns <= *trajectory.poses[i - 1].stamp_ns)
      throw Error(where, "is not later than the time before");
  }
}

Eigen::Isometry3d T_camera_sensor_axes() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
  return T;
}

Eigen::Isometry3d read_kitti_calibration(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = read_text(file);
  const std::string key = "Tr:";
  const std::size_t start = text.starts_with(key) ? 0 : text.find("\n" + key) + 1;
  if (start == 0 && !text.starts_with(key))
    throw Error(name, "has no line \"Tr: ...\"", "calib.txt of a KITTI odometry sequence has one");
  const std::size_t values = start + key.size();
  const std::string line = text.substr(values, text.find('\n', values) - values);
  const std::vector<NumberRow> rows = parse_number_rows(line, name + " Tr");
  if (rows.empty() || rows.front().numbers.size() != kKittiColumns)
    throw Error(name, "\"Tr:\" is not followed by 12 numbers");
  return pose_of_kitti(rows.front().numbers.data(), name + " Tr");
}

void body_to_sensor(Trajectory& trajectory, const Eigen::Isometry3d& T_body_sensor) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_sensor = pose.T_world_sensor * T_body_sensor;
}

void camera_to_sensor(Trajectory& trajectory, const Eigen::Isometry3d& T_camera_sensor) {
  const Eigen::Isometry3d T_sensor_camera = T_camera_sensor.inverse();
  for (StampedPose& pose : trajectory.poses)
    pose.T_world_sensor = T_sensor_camera * pose.T_world_sensor * T_camera_sensor;
}

}  // namespace pago::evaluation
