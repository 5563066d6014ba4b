// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/odometry.hpp"

#include <cstring>
#include <vector>

#include "support/catch.hpp"
#include "support/street_drive.hpp"

using namespace pago;
using test::forward;
using test::StreetDrive;

namespace {

/// Scan to scan alone: the map takes the start's search, and then poses as they come.
MappingConfig without_map() {
  MappingConfig config;
  config.refine = false;
  return config;
}

}  // namespace

TEST_CASE("a drive at 10 m/s that starts moving is followed scan to scan", "[odometry][stage]") {
  StreetDrive drive({}, without_map());
  const Vector6d speed = forward(10.0, 0.1);
  const Estimate& first = drive.next(speed);
  REQUIRE(first.has_pose);
  REQUIRE(first.health == Health::kInit);
  REQUIRE(first.T_odom_sensor_first.isApprox(Eigen::Isometry3d::Identity()));
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < 10; ++i) {
    const Estimate& estimate = drive.next(speed);
    const Vector6d error =
        log_se3(drive.T_first_last(T_world_first).inverse() * estimate.T_odom_sensor_front_end);
    INFO("sweep " << i + 1 << " error " << error.transpose());
    if (i >= 2) REQUIRE(error.head<3>().norm() < 0.05 + 0.015 * i);
    if (i >= 2) REQUIRE(error.tail<3>().norm() < 0.01);
  }
  REQUIRE(
      drive.sweep.estimate.T_odom_sensor_first.isApprox(drive.sweep.estimate.T_odom_sensor_front_end, 1e-9));
}

TEST_CASE("a motion that no vehicle has is not believed at first", "[odometry][stage]") {
  const auto moved_m = [](double speed_m_s, const MappingConfig& mapping) {
    StreetDrive drive({}, mapping);
    for (int i = 0; i < 10; ++i) drive.next(forward(10.0));
    const Eigen::Vector3d before = drive.refined().translation();
    drive.next(forward(speed_m_s));
    return (drive.sweep.estimate.T_odom_sensor_first.translation() - before).norm();
  };
  CHECK(moved_m(9.5, {}) < moved_m(10.0, {}) - 0.02);  // 5 m/s^2
  // 25 m/s^2, which odometry alone has no reason to doubt.
  CHECK(moved_m(7.5, {}) > moved_m(7.5, without_map()) + 0.02);
}

TEST_CASE("a pose at the start or the middle lies where the sensor was then", "[odometry][stage]") {
  for (const auto& [instant, fraction] :
       {std::pair{PoseInstant::kStart, 0.0}, {PoseInstant::kMid, 0.5}, {PoseInstant::kEnd, 1.0}}) {
    OdometryConfig config;
    config.pose_instant = instant;
    StreetDrive drive(config);
    const Vector6d speed = forward(12.0);
    const Eigen::Isometry3d T_world_first = drive.T_world_start * exp_se3(speed * 0.1 * fraction);
    for (int i = 0; i < 4; ++i) drive.next(speed);
    const Eigen::Isometry3d T_world_last = drive.T_world_start * exp_se3(speed * 0.1 * (fraction - 1.0));
    const Eigen::Vector3d travelled = (T_world_first.inverse() * T_world_last).translation();
    REQUIRE((drive.sweep.estimate.T_odom_sensor_first.translation() - travelled).norm() < 0.08);
    REQUIRE((drive.refined().translation() - travelled).norm() < 0.05);
    REQUIRE(drive.sweep.estimate.stamp_ns ==
            drive.sweep.header.start_ns + static_cast<std::int64_t>(1e8 * fraction));
  }
}

// Both sweeps are bent alike while the turn rate stays the same: it is its change that tells.
TEST_CASE("without de-skew a drive into a bend is several times worse", "[odometry][stage]") {
  const auto error_of = [](bool deskew) {
    OdometryConfig config;
    config.deskew = deskew;
    StreetDrive drive(config, without_map());
    for (int i = 0; i < 8; ++i) drive.next(forward(10.0));
    const Eigen::Isometry3d T_world_first = drive.T_world_start;
    const Eigen::Isometry3d T_odom_first = drive.sweep.estimate.T_odom_sensor_front_end;
    for (int i = 1; i <= 4; ++i) drive.next(forward(10.0, 0.3 * i));
    return log_se3(drive.T_first_last(T_world_first).inverse() * T_odom_first.inverse() *
                   drive.sweep.estimate.T_odom_sensor_front_end)
        .tail<3>()
        .norm();
  };
  const double with = error_of(true), without = error_of(false);
  INFO(with << " rad against " << without);
  REQUIRE(with < 0.5 * without);
}

TEST_CASE("reset, odometry begins as with the very first sweep", "[odometry][stage]") {
  StreetDrive drive;
  for (int i = 0; i < 4; ++i) drive.next(forward(5.0));
  REQUIRE(drive.refined().translation().x() > 1.0);
  drive.odometry.reset();
  drive.mapping.reset();
  const Estimate& again = drive.next(forward(5.0));
  REQUIRE(again.reason == HealthReason::kFirstSweep);
  REQUIRE(again.T_odom_sensor_front_end.isApprox(Eigen::Isometry3d::Identity()));
  REQUIRE(again.T_odom_sensor_first.isApprox(Eigen::Isometry3d::Identity()));
  REQUIRE(again.T_odom_sensor_refined.isApprox(Eigen::Isometry3d::Identity()));
}

TEST_CASE("the same sweeps give the same bytes", "[odometry][stage]") {
  const auto poses = [] {
    std::vector<double> values;
    StreetDrive drive;
    for (int i = 0; i < 4; ++i) {
      const Estimate& estimate = drive.next(forward(9.0, -0.2));
      const Eigen::Matrix4d first = estimate.T_odom_sensor_first.matrix();
      const Eigen::Matrix4d refined = estimate.T_odom_sensor_refined.matrix();
      values.insert(values.end(), first.data(), first.data() + 16);
      values.insert(values.end(), refined.data(), refined.data() + 16);
    }
    return values;
  };
  const auto a = poses(), b = poses();
  REQUIRE(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
