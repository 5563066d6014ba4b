// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "baseline.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <unordered_set>

#include "pago/core/units.hpp"

namespace pago::baseline {
namespace {

// The paper's parameters (table I and section IV).
constexpr double kLeastRange_m = 5.0, kMostRange_m = 100.0;
constexpr double kCube_m = 0.01 * kMostRange_m;  // of the map
constexpr double kMapSpacing_m = 0.5 * kCube_m, kSourceSpacing_m = 1.5 * kCube_m;
constexpr double kFirstSigma_m = 2.0, kLeastCorrection_m = 0.1;
constexpr int kMostSteps = 500;
constexpr double kLastStep = 1e-4;

// A sensor that was silent for longer has no known velocity.
constexpr double kLongestPeriod_s = 1.0;

/// Three signed numbers of 21 bits each: a thousand kilometres of cubes.
std::uint64_t key_of(const Eigen::Vector3i& cube) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  const auto part = [&](int i) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cube[i])) & kMask;
  };
  return part(0) << 42U | part(1) << 21U | part(2);
}

Eigen::Vector3i cube_of(const Eigen::Vector3d& point_m, double side_m) {
  return (point_m / side_m).array().floor().cast<int>();
}

/// The first point of every cube.
Points thinned(const Points& points, double side_m) {
  std::unordered_set<std::uint64_t> taken;
  Points kept;
  for (const Eigen::Vector3d& point : points)
    if (taken.insert(key_of(cube_of(point, side_m))).second) kept.push_back(point);
  return kept;
}

}  // namespace

void VoxelMap::add(const Points& points, const Eigen::Isometry3d& T_map_points) {
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d placed = T_map_points * point;
    Cube& cube = cubes_[key_of(cube_of(placed, kCube_m))];
    if (cube.size < kMostPoints) cube.points_m[cube.size++] = placed;
  }
}

void VoxelMap::keep_around(const Eigen::Vector3d& centre_m, double range_m) {
  std::erase_if(cubes_, [&](const auto& entry) {
    return (entry.second.points_m[0] - centre_m).squaredNorm() > range_m * range_m;
  });
}

const Eigen::Vector3d* VoxelMap::nearest(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3i middle = cube_of(point_m, kCube_m);
  const Eigen::Vector3d within_m = point_m - kCube_m * middle.cast<double>();
  const Eigen::Vector3d* best = nullptr;
  double best_m2 = HUGE_VAL;
  constexpr int kOwn = 13;
  for (int k = 0; k < 27; ++k) {
    const int i = (k + kOwn) % 27;  // its own cube first: most others need not be looked into then
    const Eigen::Vector3i step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    double apart_m2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap_m = step[axis] < 0 ? within_m[axis] : kCube_m - within_m[axis];
      if (step[axis] != 0) apart_m2 += gap_m * gap_m;
    }
    if (apart_m2 >= best_m2) continue;
    const auto found = cubes_.find(key_of(middle + step));
    if (found == cubes_.end()) continue;
    for (std::uint32_t n = 0; n < found->second.size; ++n) {
      const double distance_m2 = (found->second.points_m[n] - point_m).squaredNorm();
      if (distance_m2 >= best_m2) continue;
      best_m2 = distance_m2;
      best = &found->second.points_m[n];
    }
  }
  return best;
}

double AdaptiveThreshold::sigma_m() const noexcept {
  return count_ == 0 ? kFirstSigma_m : std::sqrt(sum_m2_ / count_);
}

void AdaptiveThreshold::add(const Eigen::Isometry3d& correction) noexcept {
  const double half_turn_rad = 0.5 * log_so3(correction.linear()).norm();
  const double moved_m = 2.0 * kMostRange_m * std::sin(half_turn_rad) + correction.translation().norm();
  if (moved_m <= kLeastCorrection_m) return;  // standing still says nothing about predictions
  sum_m2_ += moved_m * moved_m;
  ++count_;
}

Eigen::Isometry3d MovingPose::at(std::int64_t sensor_ns) const noexcept {
  return T_odom_sensor * exp_se3(twist * seconds(sensor_ns - reference_ns));
}

const MovingPose& Odometry::add(const Sweep& sweep) {
  const SweepHeader& header = sweep.header;
  MovingPose now = pose_;
  now.reference_ns = header.start_ns + (header.end_ns - header.start_ns) / 2;
  const double period_s = seconds(now.reference_ns - pose_.reference_ns);
  if (has_pose_ && (period_s <= 0.0 || period_s > kLongestPeriod_s)) {
    pose_.twist.setZero();
    pose_.reference_ns = now.reference_ns;
  }
  const Points points = deskewed(sweep);
  const Points map_points = thinned(points, kMapSpacing_m);
  if (!map_.is_empty()) {
    const Eigen::Isometry3d T_predicted = pose_.at(now.reference_ns);
    now.T_odom_sensor = align(thinned(map_points, kSourceSpacing_m), T_predicted);
    threshold_.add(T_predicted.inverse() * now.T_odom_sensor);
  }
  const Vector6d motion = difference(pose_.T_odom_sensor, now.T_odom_sensor);
  now.twist =
      now.reference_ns > pose_.reference_ns && has_pose_ ? Vector6d(motion / period_s) : Vector6d::Zero();
  map_.add(map_points, now.T_odom_sensor);
  map_.keep_around(now.T_odom_sensor.translation(), kMostRange_m);
  pose_ = now;
  has_pose_ = true;
  return pose_;
}

/// In the frame of the sweep's middle, moved there by the velocity of the last sweep.
Points Odometry::deskewed(const Sweep& sweep) const {
  const bool moves = !sweep.header.has(kCompensated);
  const std::int64_t middle_ns = (sweep.header.end_ns - sweep.header.start_ns) / 2;
  Points points;
  Eigen::Isometry3d T_middle_firing = Eigen::Isometry3d::Identity();
  std::int64_t firing_ns = middle_ns;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3d point = Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>();
    const double range_m = point.norm();
    if (range_m < kLeastRange_m || range_m > kMostRange_m) continue;
    if (moves && sweep.time_offset_ns[i] != firing_ns) {
      firing_ns = sweep.time_offset_ns[i];
      T_middle_firing = exp_se3(pose_.twist * seconds(firing_ns - middle_ns));
    }
    points.push_back(T_middle_firing * point);
  }
  return points;
}

/// Gauss-Newton on distances to the nearest points, with the Geman-McClure kernel of the adaptive threshold.
Eigen::Isometry3d Odometry::align(const Points& points, Eigen::Isometry3d T_odom_sensor) const {
  const double sigma_m = threshold_.sigma_m();
  const double farthest_m2 = 9.0 * sigma_m * sigma_m, kernel = sigma_m / 3.0;
  for (int step = 0; step < kMostSteps; ++step) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d placed = T_odom_sensor * point;
      const Eigen::Vector3d* const target = map_.nearest(placed);
      if (target == nullptr) continue;
      const Eigen::Vector3d residual = placed - *target;
      const double residual_m2 = residual.squaredNorm();
      if (residual_m2 > farthest_m2) continue;
      const double weight = std::pow(kernel / (kernel + residual_m2), 2.0);
      Eigen::Matrix<double, 3, 6> J;
      J << Eigen::Matrix3d::Identity(), -hat(placed);
      H.noalias() += weight * J.transpose() * J;
      b.noalias() += weight * J.transpose() * residual;
    }
    const Vector6d change = H.ldlt().solve(-b);
    if (!change.allFinite()) break;
    T_odom_sensor = orthonormalized(exp_se3(change) * T_odom_sensor);
    if (change.norm() < kLastStep) break;
  }
  return T_odom_sensor;
}

}  // namespace pago::baseline
