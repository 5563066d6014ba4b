// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "baseline/baseline.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::baseline;

constexpr std::int64_t kSweep_ns = 100'000'000;
constexpr std::uint32_t kNumPoints = 4000;

/// Points here and there, which every sweep sees again: what is left of the error is the method's own.
Points clutter() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-60.0, 60.0), up(-2.0, 8.0);
  Points points;
  for (std::uint32_t i = 0; i < kNumPoints; ++i)
    points.emplace_back(across(random), across(random), up(random));
  return points;
}

/// Sees each point when the head, turning clockwise from behind, faces it, from where the sensor is then.
void scan(const Points& world,
          const Eigen::Isometry3d& T_world_start,
          const Vector6d& twist,
          int number,
          Sweep& sweep) {
  sweep.reset();
  sweep.header.sequence = static_cast<std::uint64_t>(number);
  sweep.header.start_ns = 1'000'000'000 + number * kSweep_ns;
  sweep.header.end_ns = sweep.header.start_ns + kSweep_ns;
  for (const Eigen::Vector3d& point : world) {
    double part = 0.5;
    Eigen::Vector3d seen;
    for (int round = 0; round < 5; ++round) {
      seen = (T_world_start * exp_se3(0.1 * part * twist)).inverse() * point;
      part = 0.5 - std::atan2(seen.y(), seen.x()) / (2.0 * std::numbers::pi);
    }
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = static_cast<float>(seen.x());
    sweep.y_m[i] = static_cast<float>(seen.y());
    sweep.z_m[i] = static_cast<float>(seen.z());
    sweep.time_offset_ns[i] = static_cast<std::int32_t>(part * kSweep_ns);
  }
}

Eigen::Isometry3d shifted(double x_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, 0.0));
}

TEST_CASE("the map gives the nearest point of the cubes around, and forgets what is far", "[baseline]") {
  VoxelMap map;
  CHECK(map.is_empty());
  map.add({{0.9, 0.5, 0.5}, {-0.1, 0.5, 0.5}, {50.0, 0.0, 0.0}}, Eigen::Isometry3d::Identity());
  REQUIRE(map.nearest({0.05, 0.5, 0.5}) != nullptr);
  CHECK(map.nearest({0.05, 0.5, 0.5})->x() == -0.1);  // in the cube below
  CHECK(map.nearest({10.0, 0.0, 0.0}) == nullptr);
  map.keep_around({50.0, 0.0, 0.0}, 30.0);
  CHECK(map.nearest({0.05, 0.5, 0.5}) == nullptr);
  CHECK(map.nearest({50.0, 0.0, 0.0}) != nullptr);
}

TEST_CASE("a cube keeps its first twenty points", "[baseline]") {
  VoxelMap map;
  Points points;
  for (int i = 0; i < 30; ++i) points.emplace_back(0.01 + 0.02 * i, 0.5, 0.5);
  map.add(points, shifted(7.0));
  CHECK(map.nearest({7.6, 0.5, 0.5})->x() == Approx(7.0 + 0.01 + 0.02 * 19));
}

TEST_CASE("the threshold starts at 2 m, follows corrections and ignores standing still", "[baseline]") {
  AdaptiveThreshold threshold;
  CHECK(threshold.sigma_m() == 2.0);
  threshold.add(shifted(0.05));
  CHECK(threshold.sigma_m() == 2.0);
  threshold.add(shifted(0.3));
  threshold.add(shifted(0.4));
  CHECK(threshold.sigma_m() == Approx(std::sqrt((0.09 + 0.16) / 2.0)));
  // A turn moves a point at the greatest range by its chord.
  AdaptiveThreshold turned;
  turned.add(Eigen::Isometry3d(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ())));
  CHECK(turned.sigma_m() == Approx(2.0 * 100.0 * std::sin(0.005)));
}

TEST_CASE("it drives off and through a bend, with returns distorted by the motion", "[baseline]") {
  const Points world = clutter();
  Sweep sweep(kNumPoints);
  Odometry odometry;
  Eigen::Isometry3d T_world_start = Eigen::Isometry3d::Identity(), T_world_middle;
  Vector6d twist = Vector6d::Zero();
  MovingPose pose;
  for (int i = 0; i < 25; ++i) {
    twist[0] = std::min(8.0, 0.5 * i);
    twist[5] = 0.05 * twist[0];
    scan(world, T_world_start, twist, i, sweep);
    pose = odometry.add(sweep);
    T_world_middle = T_world_start * exp_se3(0.05 * twist);
    T_world_start = T_world_start * exp_se3(0.1 * twist);
  }
  CHECK(T_world_middle.translation().norm() > 10.0);
  const Vector6d error = difference(T_world_middle, pose.T_odom_sensor);
  CHECK(error.head<3>().norm() < 0.02);
  CHECK(error.tail<3>().norm() < 0.001);
  CHECK(pose.twist[0] == Approx(8.0).margin(0.02));
  CHECK(pose.twist[5] == Approx(0.4).margin(0.002));
  CHECK(difference(T_world_start, pose.at(sweep.header.end_ns)).head<3>().norm() < 0.02);
}

TEST_CASE("the same sweeps give the same bits", "[baseline]") {
  const Points world = clutter();
  Sweep sweep(kNumPoints);
  Odometry first, second;
  for (int i = 0; i < 3; ++i) {
    scan(world, shifted(0.3 * i), Vector6d::Zero(), i, sweep);
    const Eigen::Matrix4d pose = first.add(sweep).T_odom_sensor.matrix();
    CHECK(pose == second.add(sweep).T_odom_sensor.matrix());
  }
}

TEST_CASE("scans that are compensated already are taken as they are", "[baseline]") {
  const Points world = clutter();
  Sweep sweep(kNumPoints);
  Odometry odometry;
  MovingPose pose;
  for (int i = 0; i < 4; ++i) {
    scan(world, shifted(0.5 * i), Vector6d::Zero(), i, sweep);
    sweep.header.flags |= kCompensated;
    pose = odometry.add(sweep);
  }
  CHECK(difference(shifted(1.5), pose.T_odom_sensor).norm() < 1e-3);

  SECTION("and one with nothing to see is carried on at constant velocity") {
    sweep.reset();
    sweep.header.start_ns = 1'000'000'000 + 4 * kSweep_ns;
    sweep.header.end_ns = sweep.header.start_ns + kSweep_ns;
    CHECK(difference(shifted(2.0), odometry.add(sweep).T_odom_sensor).norm() < 2e-3);
  }
  SECTION("after a long silence nothing is carried on") {
    scan(world, shifted(1.6), Vector6d::Zero(), 40, sweep);
    sweep.header.flags |= kCompensated;
    pose = odometry.add(sweep);
    CHECK(difference(shifted(1.6), pose.T_odom_sensor).norm() < 1e-3);
    CHECK(pose.twist.norm() == 0.0);
  }
}

}  // namespace
