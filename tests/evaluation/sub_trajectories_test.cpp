// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/sub_trajectories.hpp"

#include <cmath>
#include <numbers>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "pago/evaluation/motion.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;

TEST_CASE("a scale error is the same part of every length", "[evaluation][sub_trajectories]") {
  const Trajectory truth = chain(planar(0.5, 0, 0), 400, "truth");
  const auto errors = sub_trajectory_errors(by_row(truth, chain(planar(0.51, 0, 0), 400, "estimate")));
  REQUIRE(errors.size() == 5);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const SubTrajectoryErrors& e = errors[i];
    CHECK(e.length_m == Approx(20.0 * static_cast<double>(i + 1)).margin(0.0101));
    // From every row that has one at the length (to a step) ahead of it, within 20 %.
    CHECK(e.translation_m.count >= 401 - static_cast<std::size_t>(e.length_m / 0.5));
    CHECK(e.translation_percent.median == Approx(2.0).epsilon(0.02));
    CHECK(e.translation_percent.max <= 2.0 * (1.0 + 0.25 / e.length_m) + 1e-9);
    CHECK(e.rotation_deg.max < 1e-6);
  }
}

TEST_CASE("yaw and tilt are told apart by the world's vertical", "[evaluation][sub_trajectories]") {
  // The whole drive goes down a slope of 10 degrees: a turn about the sensor's z is not all yaw there.
  Eigen::Isometry3d slope = Eigen::Isometry3d::Identity();
  slope.rotate(Eigen::AngleAxisd(10.0 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()));
  const double turn_rad = 1e-4;
  const Trajectory truth = moved(slope, chain(planar(1, 0, 0), 100, "truth"));
  const Trajectory estimate = moved(slope, chain(planar(1, 0, turn_rad), 100, "estimate"));
  const auto errors = sub_trajectory_errors(by_row(truth, estimate), {.parts = {}, .lengths_m = {50}});
  REQUIRE(errors.size() == 1);
  const double turned_deg = 50 * turn_rad * 180.0 / std::numbers::pi;
  CHECK(errors[0].rotation_deg.median == Approx(turned_deg));
  CHECK(errors[0].yaw_deg.median == Approx(turned_deg * std::cos(std::numbers::pi / 18)).epsilon(1e-3));
  CHECK(errors[0].tilt_deg.median == Approx(turned_deg * std::sin(std::numbers::pi / 18)).epsilon(1e-2));
}

/// The definition, row by row: the closest row ahead within a fifth of the length, the first one of equals.
std::vector<double> plain_translation_errors(const MatchedTrajectories& m, double length_m) {
  std::vector<Eigen::Isometry3d> truth;
  for (const MatchedPose& pose : m.poses) truth.push_back(pose.T_world_sensor_truth);
  const std::vector<double> distance_m = distances_m(truth);
  std::vector<double> errors;
  for (std::size_t i = 0; i < m.poses.size(); ++i) {
    std::size_t best = m.poses.size();
    double difference_m = 0.2 * length_m;
    for (std::size_t j = i; j < m.poses.size(); ++j) {
      const double d = std::abs(distance_m[j] - (distance_m[i] + length_m));
      if (d < difference_m) {
        best = j;
        difference_m = d;
      }
    }
    if (best == m.poses.size()) continue;
    const Eigen::Isometry3d E =
        (truth[i].inverse() * truth[best]).inverse() *
        (m.poses[i].T_world_sensor_estimate->inverse() * *m.poses[best].T_world_sensor_estimate);
    errors.push_back(E.translation().norm());
  }
  return errors;
}

TEST_CASE("the search finds the rows that trying all of them finds", "[evaluation][sub_trajectories]") {
  Trajectory truth = winding(1, 250, "truth");
  // Standing still gives equal distances.
  for (std::size_t i = 100; i < 120; ++i) truth.poses[i].T_world_sensor = truth.poses[99].T_world_sensor;
  const MatchedTrajectories matched = by_row(truth, drifting(truth, 2));
  for (const double length_m : {3.0, 40.0, 111.0, 210.0}) {
    const auto errors = sub_trajectory_errors(matched, {.parts = {}, .lengths_m = {length_m}});
    const Statistics plain = statistics_of(plain_translation_errors(matched, length_m));
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].translation_m.count == plain.count);
    CHECK(errors[0].translation_m.rmse == Approx(plain.rmse).epsilon(1e-12));
    CHECK(errors[0].translation_m.median == Approx(plain.median).epsilon(1e-12));
  }
}

TEST_CASE("sub-trajectories that make no sense are refused, those beyond the path left out",
          "[evaluation][sub_trajectories]") {
  const Trajectory truth = chain(planar(1, 0, 0), 70, "truth");
  const MatchedTrajectories matched = by_row(truth, truth);
  CHECK_THROWS_AS(sub_trajectory_errors(matched, {.parts = {0.0}, .lengths_m = {}}), pago::Error);
  CHECK_THROWS_AS(sub_trajectory_errors(matched, {.parts = {1.5}, .lengths_m = {}}), pago::Error);
  CHECK_THROWS_AS(sub_trajectory_errors(matched, {.parts = {}, .lengths_m = {-1.0}}), pago::Error);
  CHECK_THROWS_AS(sub_trajectory_errors(matched, {.parts = {0.1}, .lengths_m = {}, .max_difference = 0.0}),
                  pago::Error);
  CHECK(sub_trajectory_errors(matched, {.parts = {}, .lengths_m = {500.0}}).empty());
  const Trajectory standing = chain(Eigen::Isometry3d::Identity(), 10, "standing");
  CHECK(sub_trajectory_errors(by_row(standing, standing)).empty());
}

}  // namespace
