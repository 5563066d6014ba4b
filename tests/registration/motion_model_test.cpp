// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/motion_model.hpp"

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using registration::may_follow;

namespace {

constexpr double kPeriod_s = 0.1;

Vector6d driving(double speed_m_s, double turn_rad_s = 0.0) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = speed_m_s, twist[5] = turn_rad_s;
  return twist;
}

Eigen::Isometry3d moved(double speed_m_s, double turn_rad_s = 0.0) {
  return exp_se3(driving(speed_m_s, turn_rad_s) * kPeriod_s);
}

}  // namespace

TEST_CASE("brakes and steering may follow a motion, a stop at once may not", "[registration][motion_model]") {
  const Vector6d before = driving(9.0, 0.2);
  CHECK(may_follow(moved(9.0, 0.2), before, kPeriod_s, 0));
  CHECK(may_follow(moved(8.1, 0.2), before, kPeriod_s, 0));  // 9 m/s^2
  CHECK(may_follow(moved(9.0, 0.4), before, kPeriod_s, 0));  // 2 rad/s^2
  CHECK_FALSE(may_follow(moved(0.0, 0.2), before, kPeriod_s, 0));
  CHECK_FALSE(may_follow(moved(9.0, -0.2), before, kPeriod_s, 0));
}

TEST_CASE("the longer nothing has confirmed a motion, the more may follow it",
          "[registration][motion_model]") {
  CHECK_FALSE(may_follow(moved(11.0), driving(9.0), kPeriod_s, 0));
  CHECK(may_follow(moved(11.0), driving(9.0), kPeriod_s, 8));
}

TEST_CASE("what was told twice is believed by its information", "[registration][motion_model]") {
  const Matrix6d one = Matrix6d::Identity();
  CHECK(fused(moved(8.0), one, moved(10.0), one).isApprox(moved(9.0), 1e-9));
  CHECK(fused(moved(8.0), 3.0 * one, moved(10.0), one).isApprox(moved(8.5), 1e-9));
  CHECK(fused(moved(8.0), one, moved(10.0), Matrix6d::Zero()).isApprox(moved(8.0), 1e-9));
  // Direction by direction: the one tells how far, the other how much it turned.
  Matrix6d far = 1e-6 * one, turned = 1e-6 * one;
  far.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity();
  turned.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity();
  const Eigen::Isometry3d both = fused(moved(8.0, 0.0), far, moved(0.0, 0.5), turned);
  CHECK(both.translation().x() == Approx(0.8).margin(0.01));
  CHECK(log_se3(both)[5] == Approx(0.05).margin(0.001));
}
