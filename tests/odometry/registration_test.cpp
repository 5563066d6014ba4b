// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/registration.hpp"

#include <Eigen/Eigenvalues>

#include "pago/core/se3.hpp"
#include "pago/features/features.hpp"
#include "support/catch.hpp"
#include "support/street.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

/// Two compensated looks at the street, T_first_second apart, as features.
struct RegisteredPair {
  RegisteredPair(const Eigen::Isometry3d& T_first_second, double noise_m, const OdometryConfig& config = {})
      : targets(config, test::kStreetReturns), sources(test::kStreetReturns) {
    const test::Street street;
    features::FeaturesStage extract(FeaturesConfig{}, test::kStreetReturns);
    Sweep sweep(test::kStreetReturns);
    const auto look = [&](const Eigen::Isometry3d& T_world_sensor, std::int64_t at_ns) {
      street.scan(T_world_sensor, Vector6d::Zero(), at_ns, noise_m, sweep);
      process(extract, sweep);
    };
    const auto fill = [&](const auto& edges, const auto& planars, FeatureSet& set) {
      const auto add = [&](PointCloud& cloud, std::uint32_t i) {
        cloud.add({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, 0.0F, sweep.ring[i]);
      };
      for (const auto i : edges) add(set.edges, i);
      for (const auto i : planars) add(sweep.ground[i] == kGround ? set.ground : set.walls, i);
    };
    FeatureSet last(test::kStreetReturns);
    look(test::street_start(), 0);
    fill(sweep.features.edges, sweep.features.planars, last);
    targets.build(last, Vector6d::Zero());
    look(test::street_start() * T_first_second, 100'000'000);
    fill(sweep.features.sharp_edges, sweep.features.flat_planars, sources);
  }
  Targets targets;
  FeatureSet sources;
};

Eigen::Isometry3d motion_of(double forward_m, double yaw_deg, double pitch_deg) {
  Vector6d xi;
  xi << forward_m, 0.05, 0.02, 0.0, pitch_deg * 0.0174533, yaw_deg * 0.0174533;
  return exp_se3(xi);
}

}  // namespace

TEST_CASE("two steps find a known motion from a guess that is half a metre off", "[odometry][registration]") {
  OdometryConfig config;
  config.targets = GENERATE(TargetKind::kCells, TargetKind::kRings);
  const Eigen::Isometry3d T_true = motion_of(0.5, 1.0, 0.3);
  RegisteredPair pair(T_true, 0.01, config);
  TwoStepRegistration registration(config, 8000);
  const RegistrationResult result =
      registration.align(pair.sources, pair.targets, Eigen::Isometry3d::Identity(), 0.0);
  const Vector6d error = log_se3(T_true.inverse() * result.T_target_source);
  INFO("error " << error.transpose());
  REQUIRE(error.head<3>().norm() < 0.02);
  REQUIRE(error.tail<3>().norm() < 0.002);
  REQUIRE(result.ground_matches > 500);
  REQUIRE(result.weak.count == 0);
}

TEST_CASE("the stated information fits the spread of the errors", "[odometry][registration]") {
  // Normalised squared error over several noise draws; a wildly wrong covariance would leave these generous
  // bounds.
  TwoStepRegistration registration(OdometryConfig{}, 8000);
  double sum = 0.0;
  constexpr int kDraws = 6;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Isometry3d T_true = motion_of(0.5 + 0.1 * i, 0.5 * i, 0.0);
    RegisteredPair pair(T_true, 0.02);
    const RegistrationResult result = registration.align(pair.sources, pair.targets, T_true, 0.0);
    const Vector6d error = log_se3(T_true.inverse() * result.T_target_source);
    sum += error.dot(result.information * error);
  }
  INFO("mean normalised squared error " << sum / kDraws << " (6 expected of an exact one)");
  REQUIRE(sum / kDraws < 200.0);
  REQUIRE(sum / kDraws > 0.06);
}

TEST_CASE("the paper's gain of 0.05 leaves most of an unpredicted motion", "[odometry][registration]") {
  const Eigen::Isometry3d T_true = motion_of(1.0, 0.0, 0.0);
  RegisteredPair pair(T_true, 0.0);
  OdometryConfig config;
  config.update_gain = 0.05;
  TwoStepRegistration damped(config, 8000);
  const RegistrationResult result =
      damped.align(pair.sources, pair.targets, Eigen::Isometry3d::Identity(), 0.0);
  REQUIRE(result.T_target_source.translation().x() < 0.8);
}

TEST_CASE("without features the guess comes back", "[odometry][registration]") {
  const FeatureSet nothing(10);
  Targets no_targets(OdometryConfig{}, 10);
  TwoStepRegistration registration(OdometryConfig{}, 10);
  const Eigen::Isometry3d T_guess = motion_of(0.7, 1.0, 0.0);
  const RegistrationResult result = registration.align(nothing, no_targets, T_guess, 0.1);
  REQUIRE(result.T_target_source.isApprox(T_guess, 1e-12));
  REQUIRE(result.ground_matches == 0);
  REQUIRE(result.information.isZero());
}
