// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/odometry.hpp"

#include <cstring>
#include <vector>

#include "pago/core/se3.hpp"
#include "pago/features/features.hpp"
#include "support/catch.hpp"
#include "support/street.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

/// Drives along the street sweep by sweep at constant twist and keeps what the odometry says.
struct Drive {
  explicit Drive(const OdometryConfig& config = {})
      : sweep(test::kStreetReturns),
        extract(FeaturesConfig{}, test::kStreetReturns),
        odometry(config, test::kStreetReturns) {}

  const Estimate& next(const Vector6d& twist) {
    street.scan(T_world_start, twist, now_ns, 0.01, sweep);
    extract.finish(sweep);
    odometry.finish(sweep);
    T_world_start = T_world_start * exp_se3(twist * 0.1);
    now_ns += 100'000'000;
    return sweep.estimate;
  }
  /// The same with nothing to see: as under a cover.
  const Estimate& next_blind(const Vector6d& twist) {
    sweep.reset();
    sweep.header.start_ns = now_ns;
    sweep.header.end_ns = now_ns + 100'000'000;
    extract.finish(sweep);
    odometry.finish(sweep);
    T_world_start = T_world_start * exp_se3(twist * 0.1);
    now_ns += 100'000'000;
    return sweep.estimate;
  }
  /// Truth at the end of the last sweep, relative to the end of the first.
  Eigen::Isometry3d T_first_last(const Eigen::Isometry3d& T_world_first) const {
    return T_world_first.inverse() * T_world_start;
  }

  test::Street street;
  Sweep sweep;
  features::FeaturesStage extract;
  OdometryStage odometry;
  Eigen::Isometry3d T_world_start = test::street_start();
  std::int64_t now_ns = 1'000'000'000;
};

Vector6d twist(double forward_m_s, double yaw_rad_s) {
  Vector6d result = Vector6d::Zero();
  result[0] = forward_m_s, result[5] = yaw_rad_s;
  return result;
}

}  // namespace

TEST_CASE("a drive at 10 m/s that starts moving is followed from the second sweep on", "[odometry][stage]") {
  Drive drive;
  const Vector6d speed = twist(10.0, 0.1);
  const Estimate first = drive.next(speed);
  REQUIRE(first.has_pose);
  REQUIRE(first.health == Health::kInit);
  REQUIRE(first.T_odom_sensor_first.isApprox(Eigen::Isometry3d::Identity()));
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < 10; ++i) {
    const Estimate& estimate = drive.next(speed);
    const Vector6d error =
        log_se3(drive.T_first_last(T_world_first).inverse() * estimate.T_odom_sensor_first);
    INFO("sweep " << i + 1 << " error " << error.transpose());
    REQUIRE(estimate.health == Health::kOk);
    REQUIRE(error.head<3>().norm() < 0.05 + 0.015 * i);
    REQUIRE(error.tail<3>().norm() < 0.01);
  }
}

TEST_CASE("standing still gives no drift to speak of", "[odometry][stage]") {
  Drive drive;
  for (int i = 0; i < 8; ++i) drive.next(Vector6d::Zero());
  REQUIRE(drive.sweep.estimate.T_odom_sensor_first.translation().norm() < 0.03);
}

TEST_CASE("a pose at the start or the middle lies where the sensor was then", "[odometry][stage]") {
  for (const auto& [instant, fraction] :
       {std::pair{PoseInstant::kStart, 0.0}, {PoseInstant::kMid, 0.5}, {PoseInstant::kEnd, 1.0}}) {
    OdometryConfig config;
    config.pose_instant = instant;
    Drive drive(config);
    const Vector6d speed = twist(12.0, 0.0);
    const Eigen::Isometry3d T_world_first = drive.T_world_start * exp_se3(speed * 0.1 * fraction);
    for (int i = 0; i < 4; ++i) drive.next(speed);
    const Eigen::Isometry3d T_world_last = drive.T_world_start * exp_se3(speed * 0.1 * (fraction - 1.0));
    const Eigen::Vector3d travelled = (T_world_first.inverse() * T_world_last).translation();
    REQUIRE((drive.sweep.estimate.T_odom_sensor_first.translation() - travelled).norm() < 0.08);
    REQUIRE(drive.sweep.estimate.stamp_ns ==
            drive.sweep.header.start_ns + static_cast<std::int64_t>(1e8 * fraction));
  }
}

TEST_CASE("without de-skew the heading of a turning drive is several times worse", "[odometry][stage]") {
  const auto error_of = [](bool deskew) {
    OdometryConfig config;
    config.deskew = deskew;
    Drive drive(config);
    drive.next(twist(10.0, 0.5));
    const Eigen::Isometry3d T_world_first = drive.T_world_start;
    for (int i = 0; i < 8; ++i) drive.next(twist(10.0, 0.5));
    return log_se3(drive.T_first_last(T_world_first).inverse() * drive.sweep.estimate.T_odom_sensor_first)
        .tail<3>()
        .norm();
  };
  REQUIRE(error_of(true) < 0.3 * error_of(false));
}

TEST_CASE("covered for a while, the pose goes on at constant velocity and says so, and recovers",
          "[odometry][stage]") {
  Drive drive;
  const Vector6d speed = twist(8.0, 0.0);
  for (int i = 0; i < 4; ++i) drive.next(speed);
  const Eigen::Isometry3d T_before = drive.sweep.estimate.T_odom_sensor_first;
  double trace = drive.sweep.estimate.covariance.trace();
  for (int i = 0; i < 6; ++i) {
    const Estimate& estimate = drive.next_blind(speed);
    REQUIRE(estimate.has_pose);
    REQUIRE(estimate.reason == HealthReason::kTooFewFeatures);
    REQUIRE(estimate.health == (i < 4 ? Health::kDegraded : Health::kLost));
    REQUIRE(estimate.covariance.trace() > trace);
    trace = estimate.covariance.trace();
  }
  REQUIRE((T_before.inverse() * drive.sweep.estimate.T_odom_sensor_first).translation().x() ==
          Approx(4.8).margin(0.3));
  drive.next(speed);  // against an empty target: still predicted
  REQUIRE(drive.next(speed).health == Health::kOk);
}

TEST_CASE("partial sweeps get no pose and leave no trace", "[odometry][stage]") {
  Drive drive;
  drive.sweep.header.flags = 0;
  drive.street.scan(drive.T_world_start, twist(0.0, 0.0), 1, 0.01, drive.sweep);
  drive.sweep.header.flags = kPartialStart;
  drive.extract.finish(drive.sweep);
  drive.odometry.finish(drive.sweep);
  REQUIRE_FALSE(drive.sweep.estimate.has_pose);
  REQUIRE(drive.next(twist(0.0, 0.0)).health == Health::kInit);
}

TEST_CASE("the same sweeps give the same bytes", "[odometry][stage]") {
  const auto poses = [] {
    std::vector<double> values;
    Drive drive;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Matrix4d pose = drive.next(twist(9.0, -0.2)).T_odom_sensor_first.matrix();
      values.insert(values.end(), pose.data(), pose.data() + 16);
    }
    return values;
  };
  const auto a = poses(), b = poses();
  REQUIRE(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_CASE("a sensor clock that begins anew, or leaps, costs trust but not the pose", "[odometry][stage]") {
  for (const std::int64_t leap_ns : {-1'000'000'000'000LL, -100'000'000LL, 1'000'000'000'000LL}) {
    Drive drive;
    const Vector6d speed = twist(5.0, 0.0);
    for (int i = 0; i < 4; ++i) drive.next(speed);
    const Eigen::Vector3d before = drive.sweep.estimate.T_odom_sensor_first.translation();
    drive.now_ns += leap_ns;
    const Estimate& estimate = drive.next(speed);
    INFO("leap " << leap_ns);
    REQUIRE(estimate.health == Health::kDegraded);
    REQUIRE(estimate.reason == HealthReason::kTimeGap);
    REQUIRE((estimate.T_odom_sensor_first.translation() - before).norm() < 1.0);
    REQUIRE(drive.next(speed).health == Health::kOk);
    REQUIRE((drive.sweep.estimate.T_odom_sensor_first.translation() - before).x() ==
            Approx(1.0).margin(0.15));
  }
}
