// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/trajectory.hpp"

#include <vector>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using simulator::Trajectory;

namespace {

/// A screw motion: constant velocity and turn rate in the body's frame.
std::vector<Eigen::Isometry3d> screw(const Vector6d& twist_per_step, int count) {
  std::vector<Eigen::Isometry3d> poses;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < count; ++i) {
    poses.push_back(T);
    T = T * exp_se3(twist_per_step);
  }
  return poses;
}

Vector6d tangent(double x, double y, double z, double roll, double pitch, double yaw) {
  return (Vector6d() << x, y, z, roll, pitch, yaw).finished();
}

}  // namespace

TEST_CASE("a straight drive at constant speed is kept exactly", "[simulator][trajectory]") {
  const Trajectory trajectory(screw(tangent(0.5, 0.0, 0.1, 0, 0, 0), 6), 0.1);
  REQUIRE(trajectory.duration_s() == Approx(0.5));
  for (const double t : {0.0, 0.05, 0.1, 0.23, 0.4999, 0.5}) {
    const Eigen::Vector3d p = trajectory.pose(t).translation();
    CHECK((p - Eigen::Vector3d(5.0 * t, 0.0, t)).norm() < 1e-12);
  }
}

TEST_CASE("a turn about a fixed axis is kept exactly", "[simulator][trajectory]") {
  const Trajectory trajectory(screw(tangent(0, 0, 0, 0.0, 0.0, 0.07), 8), 0.1);
  for (const double t : {0.0, 0.13, 0.35, 0.7}) {
    const Eigen::Vector3d turned = log_so3(trajectory.pose(t).linear());
    CHECK((turned - Eigen::Vector3d(0, 0, 0.7 * t)).norm() < 1e-12);
  }
}

TEST_CASE("velocity and acceleration have no jumps at the control poses", "[simulator][trajectory]") {
  std::vector<Eigen::Isometry3d> poses = screw(tangent(0.4, 0, 0, 0.01, 0, 0.05), 12);
  poses[5] = perturb(poses[5], tangent(0.1, -0.05, 0.02, 0.01, -0.02, 0.03));  // a kink
  const Trajectory trajectory(poses, 0.1);
  const double h = 1e-4;
  const auto velocity = [&](double t) {
    return Vector6d(difference(trajectory.pose(t - h), trajectory.pose(t + h)) / (2 * h));
  };
  const auto acceleration = [&](double t) { return Vector6d((velocity(t + h) - velocity(t - h)) / (2 * h)); };
  for (int knot = 2; knot < 10; ++knot) {
    const double t = 0.1 * knot;
    CHECK((velocity(t - 1e-5) - velocity(t + 1e-5)).norm() < 1e-2);
    CHECK((acceleration(t - 5 * h) - acceleration(t + 5 * h)).norm() < 0.6);
  }
  // The kink itself is there: it is smoothed, not dropped.
  CHECK(acceleration(0.5).norm() > 3.0);
}

TEST_CASE("outside its time a trajectory stays at its ends", "[simulator][trajectory]") {
  const Trajectory trajectory(screw(tangent(1, 0, 0, 0, 0, 0.1), 4), 0.1);
  CHECK(trajectory.pose(-1.0).isApprox(trajectory.pose(0.0)));
  CHECK(trajectory.pose(9.0).isApprox(trajectory.pose(0.3)));
}

TEST_CASE("two poses make a trajectory", "[simulator][trajectory]") {
  const Trajectory trajectory(screw(tangent(1, 0, 0, 0, 0, 0), 2), 1.0);
  CHECK(trajectory.pose(0.25).translation().x() == Approx(0.25));
}
