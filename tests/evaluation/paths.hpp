// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "pago/evaluation/association.hpp"
#include "pago/evaluation/trajectory.hpp"

namespace pago::test {

using evaluation::StampedPose;
using evaluation::Trajectory;

inline Eigen::Isometry3d planar(double x_m, double y_m, double yaw_rad) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  T.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return T;
}

inline Trajectory trajectory_of(const std::vector<Eigen::Isometry3d>& poses, const std::string& name) {
  Trajectory trajectory{.name = name, .poses = {}};
  for (const Eigen::Isometry3d& T : poses)
    trajectory.poses.push_back({std::nullopt, T, trajectory.poses.size()});
  return trajectory;
}

/// `steps` equal motions one after the other.
inline Trajectory chain(const Eigen::Isometry3d& step, int steps, const std::string& name) {
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  for (int i = 0; i < steps; ++i) poses.push_back(poses.back() * step);
  return trajectory_of(poses, name);
}

inline void stamp(Trajectory& trajectory, std::int64_t start_ns, std::int64_t interval_ns) {
  for (StampedPose& pose : trajectory.poses)
    pose.stamp_ns = start_ns + static_cast<std::int64_t>(pose.row) * interval_ns;
}

inline Eigen::Isometry3d random_motion(std::mt19937& random, double metres, double radians) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = metres * vector();
  T.rotate(Eigen::AngleAxisd(radians * normal(random), vector().normalized()));
  return T;
}

/// A winding path: forward by about a metre per pose, with random turns.
inline Trajectory winding(unsigned seed, int steps, const std::string& name) {
  std::mt19937 random(seed);
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  for (int i = 0; i < steps; ++i)
    poses.push_back(poses.back() * planar(1.0, 0.0, 0.0) * random_motion(random, 0.1, 0.05));
  return trajectory_of(poses, name);
}

/// The path with an error on every motion: what an odometry makes of it.
inline Trajectory drifting(const Trajectory& truth, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::Isometry3d> poses{truth.poses.front().T_world_sensor};
  for (std::size_t i = 1; i < truth.poses.size(); ++i)
    poses.push_back(poses.back() * truth.poses[i - 1].T_world_sensor.inverse() *
                    truth.poses[i].T_world_sensor * random_motion(random, 0.01, 0.002));
  return trajectory_of(poses, "drifting");
}

/// A car in a town at 10 poses per second: smooth in speed, turns to both sides, pitches and rolls a little.
inline Trajectory town_drive(int poses, const std::string& name) {
  std::vector<Eigen::Isometry3d> path{Eigen::Isometry3d::Identity()};
  for (int i = 1; i < poses; ++i) {
    const double t = 0.1 * i, speed = 8.0 + 4.0 * std::sin(0.3 * t) + 1.5 * std::sin(1.1 * t);
    const double yaw_rate = 0.4 * std::sin(0.21 * t) * std::sin(0.47 * t + 1.0);
    Eigen::Isometry3d step = planar(0.1 * speed, 0.0, 0.1 * yaw_rate);
    step.rotate(Eigen::AngleAxisd(2e-3 * std::cos(1.7 * t), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(3e-3 * std::cos(1.3 * t), Eigen::Vector3d::UnitX()));
    path.push_back(path.back() * step);
  }
  return trajectory_of(path, name);
}

inline evaluation::MatchedTrajectories by_row(const Trajectory& truth, const Trajectory& estimate) {
  return evaluation::match(truth, estimate, {.matching = evaluation::Matching::kRow});
}

inline Trajectory moved(const Eigen::Isometry3d& T, Trajectory trajectory) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_sensor = T * pose.T_world_sensor;
  return trajectory;
}

}  // namespace pago::test
