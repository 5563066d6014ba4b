// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/loam_registration.hpp"

#include "pago/core/se3.hpp"
#include "pago/features/features.hpp"
#include "support/catch.hpp"
#include "support/street_drive.hpp"

using namespace pago;
using namespace pago::odometry;

namespace {

FeaturesConfig features_of_paper() {
  FeaturesConfig config;
  config.planar_source = PlanarSource::kGroundOnly;
  config.planar_spacing_m = 0.0;
  return config;
}

OdometryConfig loam(double gain) {
  OdometryConfig config;
  config.registration = Registration::kLoam;
  config.update_gain = gain;
  config.max_rounds = config.steps_per_round = 5;
  config.match_radius_m = 5.0;
  config.deskew = false;
  config.min_planar_matches = config.min_edge_matches = 10;
  config.stop_rotation_rad = 0.001745;
  return config;
}

/// Two compensated looks at the street, T_first_second apart.
struct Pair {
  Pair(const Eigen::Isometry3d& T_first_second,
       const OdometryConfig& config,
       const FeaturesConfig& features_config = features_of_paper())
      : registration(config), sources(test::kStreetReturns) {
    const test::Street street;
    features::FeaturesStage extract(features_config, test::kStreetReturns);
    Sweep sweep(test::kStreetReturns);
    const auto look = [&](const Eigen::Isometry3d& T_world_sensor, std::int64_t at_ns) {
      street.scan(T_world_sensor, Vector6d::Zero(), at_ns, 0.005, sweep);
      sweep.motion.is_compensated = true;
      process(extract, sweep);
    };
    look(test::street_start(), 0);
    registration.set_targets(sweep, Vector6d::Zero());
    look(test::street_start() * T_first_second, 100'000'000);
    const auto add = [&](PointCloud& cloud, std::uint32_t i) {
      cloud.add({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, 0.0F, sweep.ring[i]);
    };
    for (const auto i : sweep.features.sharp_edges) add(sources.edges, i);
    for (const auto i : sweep.features.flat_planars)
      add(sweep.ground[i] == kGround ? sources.ground : sources.walls, i);
  }
  RegistrationResult align(const Eigen::Isometry3d& T_guess) {
    return registration.align(sources, T_guess, 0.0);
  }

  LoamRegistration registration;
  FeatureSet sources;
};

Eigen::Isometry3d motion(double forward_m, double up_m, double pitch_deg) {
  Vector6d xi;
  xi << forward_m, 0.02, up_m, 0.0, pitch_deg * 0.0174533, 0.01;
  return exp_se3(xi);
}

}  // namespace

TEST_CASE("with its whole steps LOAM's registration finds a known motion", "[odometry][loam]") {
  const Eigen::Isometry3d T_true = motion(0.4, 0.03, 0.4);
  Pair pair(T_true, loam(1.0));
  const RegistrationResult result = pair.align(Eigen::Isometry3d::Identity());
  const Vector6d error = log_se3(T_true.inverse() * result.T_target_source);
  INFO("error " << error.transpose() << ", " << result.rounds << " iterations");
  REQUIRE(std::abs(error[2]) < 0.01);
  REQUIRE(std::abs(error[0]) < 0.05);
  REQUIRE(error.tail<3>().norm() < 0.004);
  REQUIRE(result.ground_matches > 300);
  REQUIRE(result.edge_matches > 50);
  REQUIRE(result.information.allFinite());
}

// 1 - 0.95^25 = 72 %, and a damped step below a millimetre ends the search: 2 cm of the way stay.
TEST_CASE("the paper's gain of 0.05 leaves a quarter of an unpredicted motion", "[odometry][loam]") {
  const Eigen::Isometry3d T_true = motion(0.0, 0.25, 0.0);
  Pair pair(T_true, loam(0.05));
  const double found_m = pair.align(Eigen::Isometry3d::Identity()).T_target_source.translation().z();
  INFO(found_m);
  REQUIRE(found_m > 0.5 * 0.25);
  REQUIRE(found_m < 0.85 * 0.25);
}

TEST_CASE("an error that the stop takes for small is left as it is", "[odometry][loam]") {
  const Eigen::Isometry3d T_true = motion(0.0, 0.015, 0.0);
  Pair pair(T_true, loam(0.05));
  REQUIRE(pair.align(Eigen::Isometry3d::Identity()).T_target_source.translation().z() < 0.005);
}

TEST_CASE("step one takes planar points alone, step two edges alone", "[odometry][loam]") {
  const Eigen::Isometry3d T_true = motion(0.3, 0.05, 0.0);
  Pair pair(T_true, loam(1.0));
  pair.sources.edges.size = 0;
  const Eigen::Vector3d without_edges =
      pair.align(Eigen::Isometry3d::Identity()).T_target_source.translation();
  REQUIRE(without_edges.z() == Approx(0.05).margin(0.01));
  REQUIRE(std::abs(without_edges.x()) < 0.005);
  Pair other(T_true, loam(1.0));
  other.sources.ground.size = other.sources.walls.size = 0;
  const Eigen::Vector3d without_planars =
      other.align(Eigen::Isometry3d::Identity()).T_target_source.translation();
  REQUIRE(without_planars.x() > 0.2);
  REQUIRE(std::abs(without_planars.z()) < 0.005);
}

TEST_CASE("surfaces can be told apart", "[odometry][loam]") {
  OdometryConfig config = loam(1.0);
  FeaturesConfig features = features_of_paper();
  features.planar_source = PlanarSource::kBoth;
  const Eigen::Isometry3d T_true = motion(0.2, 0.02, 0.2);
  config.loam.same_surface = true;
  Pair apart(T_true, config, features);
  apart.sources.ground.size = 0;  // walls have their own targets
  REQUIRE(apart.align(T_true).ground_matches > 100);
  features.planar_source = PlanarSource::kGroundOnly;
  Pair ground(T_true, config, features);
  std::swap(ground.sources.ground, ground.sources.walls);  // ground that claims to be walls
  Pair mixed(T_true, loam(1.0), features);
  std::swap(mixed.sources.ground, mixed.sources.walls);
  const double apart_rms_m = ground.align(T_true).ground_rms_m,
               mixed_rms_m = mixed.align(T_true).ground_rms_m;
  INFO(apart_rms_m << ' ' << mixed_rms_m);
  REQUIRE(apart_rms_m > 3.0 * mixed_rms_m);
}

TEST_CASE("without targets or sources the guess comes back", "[odometry][loam]") {
  LoamRegistration nothing(loam(1.0));
  const Eigen::Isometry3d T_guess = motion(0.7, 0.1, 0.0);
  const RegistrationResult result = nothing.align(FeatureSet(10), T_guess, 0.1);
  REQUIRE(result.T_target_source.isApprox(T_guess, 1e-12));
  REQUIRE(result.ground_matches == 0);
  Pair pair(T_guess, loam(1.0));
  pair.sources.edges.size = pair.sources.ground.size = pair.sources.walls.size = 0;
  REQUIRE(pair.align(T_guess).T_target_source.isApprox(T_guess, 1e-12));
}

TEST_CASE("too few sources and degenerate directions keep the guess", "[odometry][loam]") {
  const Eigen::Isometry3d T_true = motion(0.2, 0.05, 0.0);
  Pair pair(T_true, loam(1.0));
  pair.sources.ground.size = 9;
  pair.sources.edges.size = 9;
  REQUIRE(pair.align(Eigen::Isometry3d::Identity())
              .T_target_source.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  OdometryConfig config = loam(1.0);
  config.loam.min_eigenvalue = 1e8;  // nothing is strong enough
  Pair weak(T_true, config);
  REQUIRE(weak.align(Eigen::Isometry3d::Identity())
              .T_target_source.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
}

TEST_CASE("LOAM's registration follows a drive sweep by sweep, and again to the same bytes",
          "[odometry][loam]") {
  MappingConfig mapping;
  mapping.method = MappingMethod::kKeyframes;
  const auto drive = [&] {
    test::StreetDrive street(loam(1.0), mapping, features_of_paper());
    for (int i = 0; i < 6; ++i) street.next(test::forward(1.0));
    return street.sweep.estimate;
  };
  const Estimate one = drive(), two = drive();
  INFO(to_string(one.reason));
  REQUIRE(one.health == Health::kOk);
  REQUIRE(one.T_odom_sensor_front_end.translation().x() == Approx(0.5).margin(0.15));
  REQUIRE(
      (one.T_odom_sensor_front_end.matrix().array() == two.T_odom_sensor_front_end.matrix().array()).all());
}
