// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/keyframe_mapping.hpp"

#include <random>
#include <vector>

#include "pago/core/se3.hpp"
#include "src/mapping/five_point_registration.hpp"
#include "src/mapping/nearest_five.hpp"
#include "support/catch.hpp"
#include "support/street_drive.hpp"

using namespace pago;
using namespace pago::mapping;
using test::forward;
using test::StreetDrive;

namespace {

OdometryConfig loam() {
  OdometryConfig config;
  config.registration = Registration::kLoam;
  config.max_rounds = config.steps_per_round = 5;
  config.match_radius_m = 5.0;
  config.deskew = false;
  config.min_planar_matches = config.min_edge_matches = 10;
  return config;
}

MappingConfig keyframes() {
  MappingConfig config;
  config.method = MappingMethod::kKeyframes;
  return config;
}

FeaturesConfig all_planars() {
  FeaturesConfig config;
  config.planar_spacing_m = 0.0;
  return config;
}

/// A floor, two walls and four upright edges around the origin.
FeatureClouds room(double noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noise_m);
  FeatureClouds clouds;
  const auto add = [&](std::vector<Eigen::Vector3f>& to, double x, double y, double z) {
    to.push_back(Eigen::Vector3d(x + noise(random), y + noise(random), z + noise(random)).cast<float>());
  };
  for (double a = -10.0; a <= 10.0; a += 0.4) {
    for (double b = -8.0; b <= 8.0; b += 0.4) add(clouds.planars, a, b, -1.7);
    for (double z = -1.5; z <= 3.0; z += 0.4)
      add(clouds.planars, a, 8.3, z), add(clouds.planars, 10.2, 0.8 * a, z);
  }
  for (double z = -1.6; z <= 3.0; z += 0.2)
    for (const auto& [x, y] : {std::pair{6.0, 3.0}, {-5.0, 4.0}, {-6.0, -5.0}, {4.0, -6.0}})
      add(clouds.edges, x, y, z);
  return clouds;
}

FeatureClouds seen_from(const FeatureClouds& clouds, const Eigen::Isometry3d& T_map_sensor) {
  const Eigen::Isometry3d T_sensor_map = T_map_sensor.inverse();
  FeatureClouds seen;
  for (const auto& p : clouds.edges) seen.edges.push_back((T_sensor_map * p.cast<double>()).cast<float>());
  for (const auto& p : clouds.planars)
    seen.planars.push_back((T_sensor_map * p.cast<double>()).cast<float>());
  return seen;
}

Eigen::Isometry3d small_motion() {
  Vector6d xi;
  xi << 0.2, -0.1, 0.08, 0.01, -0.02, 0.03;
  return exp_se3(xi);
}

}  // namespace

TEST_CASE("five points make a line when long, a plane when flat", "[mapping][keyframes]") {
  const FivePoints on_line{Eigen::Vector3d{1, 2, 0}, {1, 2, 0.5}, {1, 2, 1}, {1, 2, 1.5}, {1, 2, 2}};
  const auto line = line_through(on_line);
  REQUIRE(line);
  REQUIRE(std::abs(line->direction.z()) == Approx(1.0));
  REQUIRE(line->centre.isApprox(Eigen::Vector3d(1, 2, 1)));
  const FivePoints on_plane{Eigen::Vector3d{3, 0, 0}, {3, 1, 0}, {3, 0, 1}, {3, 1, 1}, {3, 0.5, 0.2}};
  REQUIRE_FALSE(line_through(on_plane));
  const auto plane = plane_through(on_plane);
  REQUIRE(plane);
  REQUIRE(std::abs(plane->normal.x()) == Approx(1.0));
  for (const auto& p : on_plane) REQUIRE(plane->normal.dot(p) == Approx(plane->distance_m));
  FivePoints bent = on_plane;
  bent[4].x() = 3.6;
  REQUIRE_FALSE(plane_through(bent));
}

TEST_CASE("neighbours count only where even the fifth is near", "[mapping][keyframes]") {
  registration::KdTree tree;
  tree.build({{0.1F, 0, 0}, {0.2F, 0, 0}, {0.3F, 0, 0}, {0.4F, 0, 0}, {0.9F, 0, 0}, {5, 0, 0}});
  REQUIRE(nearest_five(tree, {0, 0, 0}, 1.0));
  REQUIRE_FALSE(nearest_five(tree, {0, 0, 0}, 0.8));
  REQUIRE_FALSE(nearest_five(tree, {4, 0, 0}, 1.0));
}

TEST_CASE("a row's Jacobian is the numerical one", "[mapping][keyframes]") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 100; ++n) {
    Vector6d xi;
    for (double& x : xi) x = normal(random);
    const Eigen::Isometry3d T = exp_se3(xi);
    const Eigen::Vector3d source = 5.0 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    const Eigen::Vector3d axis = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const double at_m = axis.dot(T * source) - 0.05;
    const auto distance = [&](const Eigen::Isometry3d& pose) { return axis.dot(pose * source) - at_m; };
    const auto row = map_row(T, source, axis, distance(T), 1.0);
    REQUIRE(row);
    REQUIRE(row->kernel_weight == Approx(std::pow(1.0 - 0.9 * 0.05, 2)));
    for (int i = 0; i < 6; ++i) {
      Vector6d step = Vector6d::Zero();
      step[i] = 1e-6;
      const double slope = (distance(perturb(T, step)) - distance(perturb(T, -step))) / 2e-6;
      REQUIRE(static_cast<double>(row->J[i]) == Approx(slope).margin(2e-4));
    }
  }
  REQUIRE_FALSE(map_row(Eigen::Isometry3d::Identity(), {1, 0, 0}, {1, 0, 0}, 1.01, 1.0));
  REQUIRE(map_row(Eigen::Isometry3d::Identity(), {1, 0, 0}, {1, 0, 0}, 1.01, 3.0));
}

TEST_CASE("a scan is moved onto the map, as far as rounds and gain allow", "[mapping][keyframes]") {
  const FeatureClouds map = room(0.003, 1);
  const Eigen::Isometry3d T_true = small_motion();
  const FeatureClouds scan = seen_from(room(0.003, 2), T_true);
  KeyframeMapConfig config;
  const auto error_of = [&](const KeyframeMapConfig& c) {
    const FivePointResult result = FivePointRegistration(c).align(map, scan, Eigen::Isometry3d::Identity());
    REQUIRE(result.is_registered);
    return log_se3(T_true.inverse() * result.T_map_sensor).norm();
  };
  const double at_rest = error_of(config);
  REQUIRE(at_rest < 0.005);
  config.max_iterations = 1;
  const double after_one = error_of(config);
  REQUIRE(after_one > 1.5 * at_rest);
  config.update_gain = 0.5;
  REQUIRE(error_of(config) > 1.5 * after_one);
  config = {};
  config.min_eigenvalue = 1e9;  // no direction is strong enough
  REQUIRE(error_of(config) == Approx(log_se3(T_true).norm()));
}

TEST_CASE("with too little map or scan nothing is registered", "[mapping][keyframes]") {
  FivePointRegistration registration{KeyframeMapConfig{}};
  const FeatureClouds map = room(0.0, 1);
  FeatureClouds few = map;
  few.edges.resize(10);
  REQUIRE_FALSE(registration.align(few, map, small_motion()).is_registered);
  FeatureClouds little;
  little.planars.assign(map.planars.begin(), map.planars.begin() + 40);
  const FivePointResult result = registration.align(map, little, small_motion());
  REQUIRE_FALSE(result.is_registered);
  REQUIRE(result.T_map_sensor.isApprox(small_motion(), 1e-12));
}

TEST_CASE("the map is made of keyframes around, one per voxel", "[mapping][keyframes]") {
  KeyframeMapConfig config;
  config.radius_m = 5.0;
  KeyframeStore store(config);
  FeatureClouds one;
  one.edges.emplace_back(0.0F, 2.0F, 0.0F);
  one.planars.assign(3, {0.0F, 0.0F, -1.0F});
  for (int i = 0; i < 40; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().x() = 0.05 + 0.3 * i;
    store.add(T, one);
  }
  const auto chosen = store.around({6.0, 0.0, 0.0});
  REQUIRE(chosen.size() == 10);  // the voxels from 1 to 10
  for (const std::size_t i : chosen) REQUIRE(std::abs(0.05 + 0.3 * static_cast<double>(i) - 6.0) <= 5.3);
  const FeatureClouds map = store.map_around({6.0, 0.0, 0.0});
  REQUIRE(map.edges.size() == 10);
  REQUIRE(map.planars.size() == 10);  // the three of each are one
  REQUIRE(map.edges[0].y() == Approx(2.0));
  config.thinning_m = 0.0;
  KeyframeStore all(config);
  for (int i = 0; i < 3; ++i) all.add(Eigen::Isometry3d::Identity(), one);
  REQUIRE(all.around({0, 0, 0}).size() == 3);
  REQUIRE(all.around({9, 0, 0}).empty());
}

TEST_CASE("every fourth sweep at 10 Hz is registered to keyframes, or every one where asked for",
          "[mapping][keyframes]") {
  const auto registered = [](const MappingConfig& mapping) {
    StreetDrive drive(loam(), mapping, all_planars());
    std::vector<int> sweeps;
    for (int i = 0; i < 10; ++i)
      if (drive.next(forward(2.0)).map_points > 0) sweeps.push_back(i);
    return sweeps;
  };
  REQUIRE(registered(keyframes()) == std::vector{4, 8});
  MappingConfig each = keyframes();
  each.keyframe_map.every_sweeps = 1, each.keyframe_map.min_interval_s = 0.0;
  REQUIRE(registered(each) == std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9});
}

TEST_CASE("keyframes keep a drive nearer to the truth than scans alone, and to the same bytes again",
          "[mapping][keyframes]") {
  OdometryConfig poor = loam();
  poor.update_gain = 0.05;
  poor.stop_rotation_rad = 0.001745;
  const auto drive = [&] {
    StreetDrive street(poor, keyframes(), all_planars());
    street.next(Vector6d::Zero());
    const Eigen::Isometry3d T_world_first = street.T_world_start;
    for (int i = 1; i <= 12; ++i) street.next(forward(0.5 * i));
    const auto error_m = [&](const Eigen::Isometry3d& T) {
      return (street.T_first_last(T_world_first).inverse() * T).translation().norm();
    };
    return std::tuple{error_m(street.sweep.estimate.T_odom_sensor_front_end), error_m(street.refined()),
                      street.refined()};
  };
  const auto [front_end_m, refined_m, T_one] = drive();
  const auto [again_m, refined_again_m, T_two] = drive();
  INFO(front_end_m << " m, refined " << refined_m << " m");
  REQUIRE(refined_m < 0.5 * front_end_m);
  REQUIRE((T_one.matrix().array() == T_two.matrix().array()).all());
}

TEST_CASE("the front end runs beside its map and takes nothing from it", "[mapping][keyframes]") {
  OdometryConfig poor = loam();
  poor.update_gain = 0.05;
  poor.stop_rotation_rad = 0.001745;
  const auto front_end = [&](int every_sweeps) {
    MappingConfig mapping = keyframes();
    mapping.keyframe_map.every_sweeps = every_sweeps;
    StreetDrive street(poor, mapping, all_planars());
    for (int i = 0; i <= 14; ++i) street.next(forward(0.5 * i));
    return std::pair{street.sweep.estimate.T_odom_sensor_front_end, street.refined()};
  };
  const auto [T_beside, T_mapped] = front_end(2);
  const auto [T_alone, T_unmapped] = front_end(100);
  REQUIRE((T_mapped.translation() - T_unmapped.translation()).norm() > 0.1);  // the map does leap
  REQUIRE((T_beside.matrix().array() == T_alone.matrix().array()).all());
}

TEST_CASE("reset, keyframes are forgotten", "[mapping][keyframes]") {
  StreetDrive drive(loam(), keyframes(), all_planars());
  for (int i = 0; i < 6; ++i) drive.next(forward(2.0));
  REQUIRE(drive.refined().translation().x() > 0.5);
  drive.odometry.reset();
  drive.mapping.reset();
  const Estimate& again = drive.next(forward(2.0));
  REQUIRE(again.T_odom_sensor_refined.isApprox(Eigen::Isometry3d::Identity()));
  REQUIRE(again.map_points == 0);
}
