// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pago/core/estimate.hpp"

namespace pago::evaluation {

/// One pose of a trajectory: of the sensor in that trajectory's own world.
struct StampedPose {
  std::optional<std::int64_t> stamp_ns;  ///< TUM files have stamps, KITTI files do not (see attach_times)
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
  std::size_t row = 0;  ///< counts poses in the file from 0; never changes, whatever is left out later
};

struct Trajectory {
  std::string name;  ///< the file it came from, for messages
  std::vector<StampedPose> poses;
  /// Of the motion from the row before to each row, as Estimate::covariance has it; empty: not known.
  std::vector<Matrix6d> motion_covariances{};

  bool has_stamps() const noexcept { return !poses.empty() && poses.front().stamp_ns.has_value(); }
};

/// Reads a trajectory; the number of columns tells the format:
///   12  KITTI: the upper 3 x 4 of the pose matrix, row by row
///    8  TUM: stamp_s x y z qx qy qz qw; stamps must rise
/// Blank lines and lines that start with # are skipped. Rotations that are off by rounding (up to 5e-3) are
/// made orthonormal. Throws Error with file:line for another or a changing number of columns, words that are
/// not finite numbers, matrices that are no rotation, and files without a pose. [set-up] allocates.
Trajectory read_trajectory(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Trajectory parse_trajectory(std::string_view text, const std::string& name);

/// Gives the rows of a KITTI trajectory the stamps of a times file (one number in seconds per line, rising).
/// Error when the counts differ, or the trajectory has stamps already.
void attach_times(Trajectory& trajectory, const std::filesystem::path& times_file);

/// Axes of the KITTI camera (x right, y down, z forward) to those of `sensor` (x forward, y left, z up),
/// without a lever arm: stands in for a calibration when both trajectories are the camera's.
Eigen::Isometry3d T_camera_sensor_axes();

/// T_camera_sensor of a KITTI calibration: the line `Tr:` of an odometry sequence's calib.txt. Error when
/// there is none.
Eigen::Isometry3d read_kitti_calibration(const std::filesystem::path& file);

/// Turns poses of a body, e.g. of base_link or of an inertial unit, into poses of the sensor that is mounted
/// on it; the world stays the body's.
void body_to_sensor(Trajectory& trajectory, const Eigen::Isometry3d& T_body_sensor);

/// Turns poses of the camera in the first camera's frame into poses of the sensor in the first sensor's
/// frame: T_sensor = Tr^-1 T_camera Tr.
void camera_to_sensor(Trajectory& trajectory, const Eigen::Isometry3d& T_camera_sensor);

}  // namespace pago::evaluation
