// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/joint_registration.hpp"

#include <random>

#include "pago/core/se3.hpp"
#include "pago/core/sweep.hpp"
#include "src/mapping/local_map.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::mapping;
using registration::CellMap;
using registration::PointCloud;

namespace {

/// Points on the floor, and on walls to both sides; with `has_ends` also across: without, it is a tunnel.
struct Room {
  explicit Room(bool has_ends) : has_ends_(has_ends) {}

  Eigen::Vector3d draw() {
    const double along = between(-25.0, 25.0), across = between(-6.0, 6.0), up = between(0.0, 5.0);
    switch (surface_ = std::uniform_int_distribution<int>(0, has_ends_ ? 4 : 2)(random)) {
      case 0:
        return {along, across, 0.0};
      case 1:
      case 2:
        return {along, surface_ == 1 ? 6.0 : -6.0, up};
      default:
        return {surface_ == 3 ? 25.0 : -25.0, across, up};
    }
  }
  std::uint8_t tag() const { return surface_ == 0 ? kGround : kNonGround; }

  void fill(CellMap& map) {
    for (int i = 0; i < 40'000; ++i) {
      const Eigen::Vector3d p = draw();
      map.insert(p, tag());
    }
  }
  /// Seen from `T_map_sensor`, in the course of a sweep of 0.1 s during which the sensor moves like that.
  void see(const Eigen::Isometry3d& T_map_sensor,
           const MotionInSweep& motion,
           double noise_m,
           PointCloud& cloud) {
    std::normal_distribution<double> noise(0.0, noise_m);
    while (cloud.size < cloud.x_m.size()) {
      const Eigen::Vector3d p = draw();
      const double before_s = between(-0.05, 0.05);
      const Eigen::Isometry3d T_map_then = T_map_sensor * motion.pose_at(-before_s);
      Eigen::Vector3d seen = T_map_then.inverse() * p;
      seen += noise(random) * seen.normalized();
      cloud.add(seen.cast<float>(), static_cast<float>(before_s), tag());
    }
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }

  std::mt19937 random{5};

 private:
  bool has_ends_;
  int surface_ = 0;
};

struct Case {
  /// `bend`: how much the velocity in the sweep's middle differs from that since the last sweep;
  /// `acceleration`: how it changes within the sweep.
  explicit Case(bool has_ends,
                double noise_m = 0.01,
                const Vector6d& bend = Vector6d::Zero(),
                const Vector6d& acceleration = Vector6d::Zero())
      : room(has_ends) {
    truth_.head<3>() << 1.0, 0.05, 0.01;
    truth_.tail<3>() << 0.002, -0.003, 0.03;
    room.fill(map);
    guess.T_map_last.translation().z() = 1.7;
    guess.period_s = 0.1;
    room.see(guess.T_map_last * exp_se3(truth_), {truth_ / guess.period_s + bend, acceleration}, noise_m,
             points);
  }
  JointResult align(const JointLimits& limits = {}, const Budget& budget = kUnlimited) {
    return registration.align(map, points, guess, limits, budget);
  }
  Vector6d error_of(const JointResult& result) const {
    return log_se3(exp_se3(truth_).inverse() * result.T_last_this);
  }

  Vector6d twist_since_last() const { return truth_ / guess.period_s; }

  MappingConfig config;
  Room room;
  CellMap map{options_of(config.cells), 20'000};
  PointCloud points{2000};
  MotionGuess guess;
  JointRegistration registration{config, 2000};

 private:
  Vector6d truth_ = Vector6d::Zero();
};

}  // namespace

TEST_CASE("a sweep distorted by its own motion is placed within millimetres", "[mapping][joint]") {
  Case c(true);
  c.guess.T_last_this.translation().x() = 0.8;
  const JointResult result = c.align();
  INFO(c.error_of(result).transpose());
  REQUIRE(c.error_of(result).head<3>().norm() < 0.003);
  REQUIRE(c.error_of(result).tail<3>().norm() < 0.0005);
  REQUIRE(result.within.twist[0] == Approx(10.0).margin(0.05));
  REQUIRE(result.weak.count == 0);
  REQUIRE(result.matches > 1500);
  REQUIRE(result.score > 0.8);
}

TEST_CASE("where the velocity changes it is found within the sweep", "[mapping][joint]") {
  Vector6d bend;
  bend << -0.1, 0.02, 0.05, 0.02, 0.04, -0.02;  // a bump, taken while braking
  Case c(true, 0.01, bend);
  c.guess.T_last_this.translation().x() = 0.9;
  const JointResult without = c.align();
  c.guess.acceleration = Vector6d::Zero();
  const JointResult with = c.align();
  const auto off_at_end = [&](const JointResult& result) -> Vector6d {
    return c.error_of(result) + 0.05 * (result.within.twist - c.twist_since_last() - bend);
  };
  INFO(off_at_end(without).transpose() << " and " << off_at_end(with).transpose());
  CHECK(off_at_end(with).tail<3>().norm() < 0.3 * off_at_end(without).tail<3>().norm());
  CHECK(off_at_end(with).head<3>().norm() < 0.004);
}

TEST_CASE("an acceleration that is expected is taken along", "[mapping][joint]") {
  Vector6d acceleration = Vector6d::Zero();
  acceleration[4] = 2.0;
  Case c(true, 0.01, 0.05 * acceleration);
  c.guess.T_last_this.translation().x() = 1.0;
  c.guess.acceleration = acceleration;
  CHECK(c.align().within.twist[4] - c.twist_since_last()[4] == Approx(0.1).margin(0.005));
}

TEST_CASE("how the velocity changes within the sweep is found, too", "[mapping][joint]") {
  Vector6d acceleration = Vector6d::Zero();
  acceleration << 0.0, 0.0, 2.0, 0.5, 3.0, 0.0;  // the front wheels meet a bump
  Case c(true, 0.01, Vector6d::Zero(), acceleration);
  c.guess.T_last_this.translation().x() = 1.0;
  c.guess.acceleration = Vector6d::Zero();
  c.guess.acceleration_sigma << 5.0, 5.0, 5.0, 5.0, 5.0, 5.0;
  const JointResult result = c.align();
  INFO(result.within.acceleration.transpose());
  CHECK(result.within.acceleration[4] == Approx(3.0).margin(0.3));
  const Eigen::Isometry3d truth = MotionInSweep{c.twist_since_last(), acceleration}.pose_at(0.05);
  const Vector6d off = difference(truth, result.within.pose_at(0.05));
  CHECK(off.head<3>().norm() < 0.003);
  CHECK(off.tail<3>().norm() < 0.0005);
  // Held to what is expected, nothing is found.
  c.guess.acceleration_sigma.setConstant(1e-3);
  CHECK(c.align().within.acceleration.norm() < 0.01);
}

TEST_CASE("compensated points are taken as they are", "[mapping][joint]") {
  Case c(true);
  c.guess.T_last_this.translation().x() = 1.0;
  c.guess.period_s = 0.0;
  const JointResult result = c.align();
  REQUIRE(result.within.twist.isZero());
  REQUIRE(result.rms_m > 0.02);  // these are distorted
}

TEST_CASE("what a tunnel does not tell is left as guessed, and named", "[mapping][joint]") {
  Case c(false);
  c.guess.T_last_this.translation().x() = 0.9;
  const JointResult result = c.align();
  REQUIRE(result.weak.count == 1);
  REQUIRE(result.weak.axes == 1);  // x
  REQUIRE(result.T_last_this.translation().x() == Approx(0.9).margin(0.01));
  REQUIRE(std::abs(result.T_last_this.translation().y() - 0.05) < 0.02);
  REQUIRE(c.error_of(result).tail<3>().norm() < 0.001);
  REQUIRE(result.weak.without(result.information)(0, 0) < 1e-3 * result.information(1, 1));
}

TEST_CASE("the stated information fits the spread of the errors", "[mapping][joint]") {
  double sum = 0.0;
  constexpr int kDraws = 30;
  Case c(true);
  for (int i = 0; i < kDraws; ++i) {
    c.points.size = 0;
    Vector6d motion = Vector6d::Zero();
    motion[0] = 1.0, motion[5] = 0.002 * i;
    c.room.see(c.guess.T_map_last * exp_se3(motion), {motion / c.guess.period_s}, c.config.point_sigma_m,
               c.points);
    c.guess.T_last_this = exp_se3(motion);
    const JointResult result = c.align();
    const Vector6d error = difference(exp_se3(motion), result.T_last_this);
    sum += error.dot(result.information * error);
  }
  // Less than 6: noise along a beam moves a point off its plane by less.
  INFO("mean normalised squared error " << sum / kDraws);
  REQUIRE(sum / kDraws > 0.6);
  REQUIRE(sum / kDraws < 6.0);
}

TEST_CASE("a search that is cut says so and has come nearer", "[mapping][joint]") {
  struct OneRound final : Budget {
    bool allows_after(int) const noexcept override { return false; }
  };
  Case c(true);
  c.guess.T_last_this.translation().x() = 0.7;
  const JointResult cut = c.align({}, OneRound());
  REQUIRE(cut.is_cut);
  REQUIRE(cut.iterations == 1);
  REQUIRE(c.error_of(cut).norm() < 0.15);
  REQUIRE_FALSE(c.align().is_cut);
}

TEST_CASE("over an empty map the guess comes back", "[mapping][joint]") {
  Case c(true);
  c.map.clear();
  c.guess.T_last_this.translation().x() = 0.7;
  const JointResult result = c.align();
  REQUIRE(result.T_last_this.isApprox(c.guess.T_last_this, 1e-12));
  REQUIRE(result.matches == 0);
  REQUIRE(result.score == 0.0);
}
