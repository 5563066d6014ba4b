// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/mapping.hpp"

#include "support/catch.hpp"
#include "support/street_drive.hpp"

using namespace pago;
using test::forward;
using test::StreetDrive;

namespace {

/// After so many sweeps it is known how the sensor moves.
constexpr int kFound = 9;

/// How far the refined pose is from the truth, when the first sweep ended at `T_world_first`.
Vector6d error_of(const StreetDrive& drive, const Eigen::Isometry3d& T_world_first) {
  return log_se3(drive.T_first_last(T_world_first).inverse() * drive.refined());
}

}  // namespace

TEST_CASE("a drive that starts in motion is followed within centimetres", "[mapping][stage]") {
  StreetDrive drive;
  const Vector6d speed = forward(10.0, 0.1);
  REQUIRE(drive.next(speed).reason == HealthReason::kFirstSweep);
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < 10; ++i) {
    const Estimate& estimate = drive.next(speed);
    const Vector6d error = error_of(drive, T_world_first);
    INFO("sweep " << i + 1 << " error " << error.transpose() << " health " << to_string(estimate.health)
                  << ' ' << to_string(estimate.reason));
    if (i >= 7) REQUIRE(estimate.health == Health::kOk);
    REQUIRE(error.head<3>().norm() < 0.04);
    REQUIRE(error.tail<3>().norm() < 0.004);
  }
}

namespace {

/// What a sensor on a roof, 1.7 m above and 1.3 m ahead of the axle, does as a vehicle pitches.
Vector6d pitching(double speed_m_s, double rate_rad_s) {
  Vector6d twist = forward(speed_m_s);
  twist[0] += 1.7 * rate_rad_s, twist[2] -= 1.3 * rate_rad_s, twist[4] = rate_rad_s;
  return twist;
}

/// The worst error over a speed bump and ten sweeps after; `health` is the worst on the way.
double error_over_a_bump_m(StreetDrive& drive, Health& health) {
  drive.next(forward(8.0));
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < kFound; ++i) drive.next(forward(8.0));
  health = Health::kOk;
  for (const double rate_rad_s : {-0.3, -0.5, 0.45, 0.45, -0.1, -0.5, -0.1, 0.5, 0.1}) {
    const Estimate& estimate = drive.next(pitching(8.0, rate_rad_s));
    if (estimate.health != Health::kOk) health = estimate.health;
  }
  double worst_m = 0.0;
  for (int i = 0; i < 10; ++i) {
    drive.next(forward(8.0));
    if (i >= 5) worst_m = std::max(worst_m, error_of(drive, T_world_first).head<3>().norm());
  }
  return worst_m;
}

}  // namespace

TEST_CASE("a speed bump is no implausible motion", "[mapping][stage]") {
  StreetDrive drive;
  Health health = Health::kLost;
  CHECK(error_over_a_bump_m(drive, health) < 0.05);
  CHECK(health == Health::kOk);
}

TEST_CASE("a sweep that was not believed spoils no velocity after it", "[mapping][stage]") {
  MappingConfig config;
  config.trust.max_acceleration_m_s2 = 12.0;
  StreetDrive drive({}, config);
  Health health = Health::kOk;
  CHECK(error_over_a_bump_m(drive, health) < 0.1);
  CHECK(health == Health::kDegraded);
}

TEST_CASE("standing still the refined pose does not creep", "[mapping][stage]") {
  StreetDrive drive;
  for (int i = 0; i < 8; ++i) drive.next(Vector6d::Zero());
  REQUIRE(drive.refined().translation().norm() < 0.01);
}

TEST_CASE("covered for a while, the pose goes on at constant velocity, says so, and is found again",
          "[mapping][stage]") {
  StreetDrive drive;
  const Vector6d speed = forward(8.0);
  drive.next(speed);
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < kFound; ++i) drive.next(speed);
  REQUIRE(drive.sweep.estimate.health == Health::kOk);
  double trace = drive.sweep.estimate.covariance.trace();
  for (int i = 0; i < 6; ++i) {
    const Estimate& estimate = drive.next_blind(speed);
    REQUIRE(estimate.has_pose);
    REQUIRE(estimate.reason == HealthReason::kTooFewFeatures);
    REQUIRE(estimate.health == (i < 4 ? Health::kDegraded : Health::kLost));
    REQUIRE(estimate.covariance.trace() > trace);
    trace = estimate.covariance.trace();
  }
  REQUIRE(error_of(drive, T_world_first).head<3>().norm() < 0.3);
  for (int i = 0; i < 3; ++i) drive.next(speed);
  REQUIRE(drive.sweep.estimate.health == Health::kOk);
  REQUIRE(error_of(drive, T_world_first).head<3>().norm() < 0.05);
}

TEST_CASE("sweeps without anything to see do not take part in the start", "[mapping][stage]") {
  StreetDrive drive;
  const Vector6d speed = forward(9.0);
  drive.next(speed);
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < 12 && drive.sweep.estimate.health == Health::kInit; ++i) {
    drive.next(speed);
    if (i > 2) continue;
    REQUIRE(drive.next_blind(speed).health == Health::kInit);
    REQUIRE(drive.sweep.estimate.reason == HealthReason::kTooFewFeatures);
  }
  REQUIRE(drive.sweep.estimate.health == Health::kOk);
  REQUIRE(error_of(drive, T_world_first).head<3>().norm() < 0.3);
}

TEST_CASE("after two seconds without a sweep the pose is found in the map", "[mapping][stage]") {
  StreetDrive drive;
  const Vector6d speed = forward(15.0), slower = forward(12.0);
  drive.next(speed);
  const Eigen::Isometry3d T_world_first = drive.T_world_start;
  for (int i = 0; i < kFound; ++i) drive.next(speed);
  drive.skip(slower, 2.0);
  for (int i = 0; i < 3; ++i) drive.next(slower);
  INFO(to_string(drive.sweep.estimate.reason) << ' ' << error_of(drive, T_world_first).transpose());
  REQUIRE(drive.sweep.estimate.health == Health::kOk);
  REQUIRE(error_of(drive, T_world_first).head<3>().norm() < 0.15);
}

TEST_CASE("where nothing is found again a new map is begun, and it is said", "[mapping][stage]") {
  MappingConfig config;
  config.trust.restart_after = 4;
  StreetDrive drive({}, config);
  for (int i = 0; i < kFound; ++i) drive.next(forward(5.0));
  const Eigen::Isometry3d T_before = drive.refined();
  for (int i = 0; i < 4; ++i) drive.next_blind(forward(5.0));
  REQUIRE(drive.sweep.estimate.reason == HealthReason::kMapRestarted);
  REQUIRE(drive.sweep.estimate.health == Health::kLost);
  REQUIRE((T_before.inverse() * drive.refined()).translation().x() == Approx(2.0).margin(0.2));
  for (int i = 0; i < 10 && drive.sweep.estimate.health != Health::kOk; ++i) drive.next(forward(5.0));
  REQUIRE(drive.sweep.estimate.health == Health::kOk);
}

TEST_CASE("sweeps far enough from the last keyframe become keyframes, once the map fits",
          "[mapping][stage]") {
  StreetDrive drive;
  std::vector<Eigen::Isometry3d> keyframes;
  for (int i = 0; i < 18; ++i) {
    const Estimate& estimate = drive.next(forward(4.0));
    if (!estimate.is_keyframe) continue;
    REQUIRE(estimate.health == Health::kOk);
    keyframes.push_back(drive.refined());
  }
  REQUIRE(keyframes.size() >= 3);
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const double apart_m = (keyframes[i - 1].inverse() * keyframes[i]).translation().norm();
    CHECK(apart_m > 0.99);
    CHECK(apart_m < 1.45);  // 0.4 m per sweep
  }
}

TEST_CASE("partial sweeps get no pose and leave no trace", "[mapping][stage]") {
  StreetDrive drive;
  Sweep partial(test::kStreetReturns);
  drive.street.scan(drive.T_world_start, Vector6d::Zero(), 1, 0.01, partial);
  partial.header.flags = kPartialStart;
  drive.odometry.finish(partial);
  drive.mapping.finish(partial);
  drive.odometry.update(partial);
  drive.mapping.update(partial);
  REQUIRE_FALSE(partial.estimate.has_pose);
  REQUIRE(drive.next(Vector6d::Zero()).reason == HealthReason::kFirstSweep);
}

TEST_CASE("a sensor clock that begins anew, or leaps, costs trust but not the pose", "[mapping][stage]") {
  for (const std::int64_t leap_ns : {-1'000'000'000'000LL, -100'000'000LL, 1'000'000'000'000LL}) {
    StreetDrive drive;
    const Vector6d speed = forward(5.0);
    for (int i = 0; i < kFound; ++i) drive.next(speed);
    const Eigen::Vector3d before = drive.refined().translation();
    drive.now_ns += leap_ns;
    const Estimate& estimate = drive.next(speed);
    INFO("leap " << leap_ns);
    REQUIRE(estimate.health == Health::kDegraded);
    REQUIRE(estimate.reason == HealthReason::kTimeGap);
    REQUIRE(drive.next(speed).health == Health::kOk);
    REQUIRE((drive.refined().translation() - before).x() == Approx(1.0).margin(0.1));
  }
}

TEST_CASE("without refinement the refined pose is the first pose", "[mapping][stage]") {
  MappingConfig config;
  config.refine = false;
  OdometryConfig odometry;
  odometry.pose_instant = PoseInstant::kMid;
  StreetDrive drive(odometry, config);
  for (int i = 0; i < kFound + 1; ++i) drive.next(forward(6.0));
  REQUIRE(drive.refined().isApprox(drive.sweep.estimate.T_odom_sensor_first, 1e-9));
}
