// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/consistency.hpp"

#include <cmath>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::evaluation;
using namespace pago::test;

/// x y z in metres, roll pitch yaw in radians, with everything correlated.
Matrix6d some_covariance() {
  Vector6d sigma;
  sigma << 0.02, 0.01, 0.03, 5e-4, 1e-3, 2e-4;
  Matrix6d correlation = Matrix6d::Constant(0.3);
  correlation.diagonal().setOnes();
  return sigma.asDiagonal() * correlation * sigma.asDiagonal();
}

/// An estimate whose every motion is off by a draw from the covariance.
Trajectory noisy(const Trajectory& truth, const Matrix6d& covariance, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Matrix6d root = covariance.llt().matrixL();
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  for (std::size_t i = 1; i < truth.poses.size(); ++i) {
    Vector6d draw;
    for (Eigen::Index k = 0; k < 6; ++k) draw[k] = normal(random);
    poses.push_back(
        poses.back() *
        perturb(truth.poses[i - 1].T_world_sensor.inverse() * truth.poses[i].T_world_sensor, root * draw));
  }
  return trajectory_of(poses, "noisy");
}

TEST_CASE("an estimate that errs as it says has the NEES of its degrees of freedom",
          "[evaluation][consistency]") {
  const Trajectory truth = town_drive(3001, "truth");
  const std::vector<Matrix6d> said(truth.poses.size(), some_covariance());
  const Consistency c = consistency_of(by_row(truth, noisy(truth, some_covariance(), 1)), said);
  CHECK(c.motions.size() == 3000);
  CHECK(c.num_unusable == 0);
  CHECK(c.is_consistent());
  CHECK(c.nees == Approx(6.0).epsilon(0.03));
  CHECK(c.translation_nees == Approx(3.0).epsilon(0.05));
  CHECK(c.rotation_nees == Approx(3.0).epsilon(0.05));
  CHECK(c.inside_percent == Approx(95.0).margin(1.5));
  for (Eigen::Index k = 0; k < 6; ++k) CHECK(c.error_per_sigma[k] == Approx(1.0).epsilon(0.05));
  // 6 (1 -+ 1.96 sqrt(2 / (6 n))) for many motions.
  CHECK(c.lower == Approx(6.0 * (1.0 - 1.96 * std::sqrt(2.0 / 18000.0))).epsilon(1e-3));
  CHECK(c.upper == Approx(6.0 * (1.0 + 1.96 * std::sqrt(2.0 / 18000.0))).epsilon(1e-3));
}

TEST_CASE("95 of 100 right estimates are within the bounds", "[evaluation][consistency]") {
  const Trajectory truth = town_drive(101, "truth");
  const std::vector<Matrix6d> said(truth.poses.size(), some_covariance());
  int num_consistent = 0;
  for (unsigned seed = 1; seed <= 100; ++seed)
    if (consistency_of(by_row(truth, noisy(truth, some_covariance(), seed)), said).is_consistent())
      ++num_consistent;
  CHECK(num_consistent >= 89);  // 95 -+ 2.8 standard deviations
  CHECK(num_consistent < 100);
}

TEST_CASE("a sigma that is too small by a factor shows as that factor", "[evaluation][consistency]") {
  const Trajectory truth = town_drive(1001, "truth");
  const auto matched = by_row(truth, noisy(truth, some_covariance(), 2));
  const std::vector<Matrix6d> right(truth.poses.size(), some_covariance());
  const std::vector<Matrix6d> sure(truth.poses.size(), some_covariance() / 9.0);
  const Consistency c = consistency_of(matched, right), too_sure = consistency_of(matched, sure);
  CHECK(too_sure.nees == Approx(9.0 * c.nees));
  CHECK(too_sure.error_per_sigma[4] == Approx(3.0 * c.error_per_sigma[4]));
  CHECK_FALSE(too_sure.is_consistent());

  std::vector<Matrix6d> wrong_in_pitch = right;
  const Vector6d scale = (Vector6d() << 1, 1, 1, 1, 0.25, 1).finished();
  for (Matrix6d& P : wrong_in_pitch) P = scale.asDiagonal() * P * scale.asDiagonal();
  const Consistency pitch = consistency_of(matched, wrong_in_pitch);
  CHECK(pitch.error_per_sigma[4] == Approx(4.0).epsilon(0.1));
  for (const Eigen::Index k : {0, 1, 2, 3, 5}) CHECK(pitch.error_per_sigma[k] == Approx(1.0).epsilon(0.1));
}

TEST_CASE("only motions between rows that follow each other count", "[evaluation][consistency]") {
  const Trajectory truth = town_drive(101, "truth");
  MatchedTrajectories matched = by_row(truth, noisy(truth, some_covariance(), 3));
  for (const std::size_t row : {10U, 50U, 51U}) matched.poses[row].T_world_sensor_estimate.reset();
  std::vector<Matrix6d> said(truth.poses.size(), some_covariance());
  CHECK(consistency_of(matched, said).motions.size() == 100 - 2 - 3);

  said[20].setZero();
  said[21](3, 3) = std::nan("");
  said[22](0, 0) = -1.0;
  const Consistency c = consistency_of(matched, said);
  CHECK(c.num_unusable == 3);
  CHECK(c.motions.size() == 95 - 3);
  CHECK(std::isfinite(c.nees));
}

TEST_CASE("covariances that do not reach the estimate's rows are refused, none at all judge nothing",
          "[evaluation][consistency]") {
  const Trajectory truth = town_drive(11, "truth");
  const auto matched = by_row(truth, truth);
  CHECK_THROWS_AS(consistency_of(matched, std::vector<Matrix6d>(10, some_covariance())), pago::Error);
  const Consistency c = consistency_of(matched, std::vector<Matrix6d>(11, Matrix6d::Zero()));
  CHECK(c.motions.empty());
  CHECK(std::isnan(c.nees));
  CHECK_FALSE(c.is_consistent());
}

}  // namespace
