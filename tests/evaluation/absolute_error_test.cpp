// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/absolute_error.hpp"

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/motion.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;

AbsoluteErrors ate(const Trajectory& truth, const Trajectory& estimate, Alignment alignment) {
  return absolute_errors(by_row(truth, estimate), alignment);
}

double rmse(const Trajectory& truth, const Trajectory& estimate, Alignment alignment) {
  return ate(truth, estimate, alignment).rmse_m;
}

TEST_CASE("an offset is the whole unaligned error and none of the aligned one",
          "[evaluation][absolute_error]") {
  const Trajectory truth = winding(1, 300, "truth");
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() = Eigen::Vector3d(3.0, -4.0, 12.0);
  const Trajectory estimate = moved(offset, truth);
  const AbsoluteErrors none = ate(truth, estimate, Alignment::kNone);
  for (const double value : {none.rmse_m, none.mean_m, none.median_m, none.max_m})
    CHECK(value == Approx(13.0));
  CHECK((none.axis_rmse_m - Eigen::Vector3d(3, 4, 12)).norm() < 1e-9);
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kYaw, Alignment::kFirstPose})
    CHECK(rmse(truth, estimate, alignment) < 1e-9);
}

TEST_CASE("a turn about the vertical is undone by yaw alignment, a tilt is not",
          "[evaluation][absolute_error]") {
  const Trajectory truth = winding(1, 300, "truth");
  CHECK(rmse(truth, moved(planar(5, 6, 2.5), truth), Alignment::kYaw) < 1e-9);

  Eigen::Isometry3d tilt = Eigen::Isometry3d::Identity();
  tilt.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY()));
  const AbsoluteErrors yaw = ate(truth, moved(tilt, truth), Alignment::kYaw);
  CHECK(yaw.rmse_m > 0.1);
  CHECK(yaw.axis_rotation_rmse_rad.y() == Approx(0.02).epsilon(0.2));
  CHECK(rmse(truth, moved(tilt, truth), Alignment::kSe3) < 1e-9);
  CHECK(rmse(truth, moved(tilt, truth), Alignment::kFirstPose) < 1e-9);
}

TEST_CASE("scale is never aligned away", "[evaluation][absolute_error]") {
  // Positions 0..100 m at 1 %: after the means coincide, the error is 1 % of a uniform spread.
  const Trajectory truth = chain(planar(1.0, 0, 0), 100, "truth");
  const Trajectory estimate = chain(planar(1.01, 0, 0), 100, "estimate");
  const double spread_m = std::sqrt((101.0 * 101.0 - 1.0) / 12.0);
  CHECK(rmse(truth, estimate, Alignment::kSe3) == Approx(0.01 * spread_m).epsilon(1e-9));
  CHECK(rmse(truth, estimate, Alignment::kYaw) == Approx(0.01 * spread_m).epsilon(1e-9));
  CHECK(ate(truth, estimate, Alignment::kNone).max_m == Approx(1.0));
  CHECK(ate(truth, estimate, Alignment::kNone).mean_m == Approx(0.5));
  CHECK(ate(truth, estimate, Alignment::kNone).median_m == Approx(0.5));
}

TEST_CASE("no other rigid motion fits better than the alignment", "[evaluation][absolute_error]") {
  const Trajectory truth = winding(1, 300, "truth");
  const Trajectory estimate = drifting(truth, 2);
  std::mt19937 random(5);
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kYaw}) {
    const AbsoluteErrors best = ate(truth, estimate, alignment);
    const Trajectory aligned = moved(best.T_truth_estimate, estimate);
    CHECK(rmse(truth, aligned, Alignment::kNone) == Approx(best.rmse_m));
    for (int i = 0; i < 200; ++i) {
      std::normal_distribution<double> normal;
      const Eigen::Isometry3d other =
          alignment == Alignment::kSe3
              ? random_motion(random, 1e-2, 1e-4)
              : planar(1e-2 * normal(random), 1e-2 * normal(random), 1e-4 * normal(random));
      CHECK(rmse(truth, moved(other, aligned), Alignment::kNone) >= best.rmse_m);
    }
  }
}

TEST_CASE("aligned errors do not change when a world is moved", "[evaluation][absolute_error]") {
  const Trajectory truth = winding(1, 300, "truth");
  const Trajectory estimate = drifting(truth, 2);
  std::mt19937 random(6);
  for (int i = 0; i < 10; ++i) {
    const auto T = random_motion(random, 30, 2), T_other = random_motion(random, 30, 2);
    for (const Alignment alignment : {Alignment::kSe3, Alignment::kFirstPose})
      CHECK(rmse(moved(T, truth), moved(T_other, estimate), alignment) ==
            Approx(rmse(truth, estimate, alignment)).epsilon(1e-9));
    CHECK(rmse(moved(T, truth), moved(T, estimate), Alignment::kNone) ==
          Approx(rmse(truth, estimate, Alignment::kNone)).epsilon(1e-9));
    const auto level = planar(7, 8, 9);
    CHECK(rmse(moved(level, truth), estimate, Alignment::kYaw) ==
          Approx(rmse(truth, estimate, Alignment::kYaw)).epsilon(1e-9));
  }
}

TEST_CASE("the alignment never mirrors, whatever the noise", "[evaluation][absolute_error]") {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    std::vector<Eigen::Isometry3d> a, b;
    for (int k = 0; k < 4; ++k) {
      a.push_back(random_motion(random, 1, 1));
      b.push_back(random_motion(random, 1, 1));
    }
    const AbsoluteErrors errors = ate(trajectory_of(a, "a"), trajectory_of(b, "b"), Alignment::kSe3);
    CHECK(errors.T_truth_estimate.linear().determinant() == Approx(1.0));
  }
}

TEST_CASE("degenerate paths have finite errors", "[evaluation][absolute_error]") {
  const Trajectory standing = chain(Eigen::Isometry3d::Identity(), 10, "standing");
  const Trajectory straight = chain(planar(1, 0, 0), 10, "straight");
  const Trajectory single = chain(Eigen::Isometry3d::Identity(), 0, "single");
  for (std::size_t i = 0; i < static_cast<std::size_t>(Alignment::kCount); ++i) {
    const auto alignment = static_cast<Alignment>(i);
    CHECK(rmse(standing, standing, alignment) < 1e-12);
    CHECK(rmse(straight, straight, alignment) < 1e-9);
    CHECK(rmse(single, single, alignment) < 1e-12);
    CHECK(std::isfinite(rmse(standing, straight, alignment)));
  }
}

TEST_CASE("without a matched pose there is no error but an Error", "[evaluation][absolute_error]") {
  MatchedTrajectories matched;
  matched.poses.push_back({0, std::nullopt, Eigen::Isometry3d::Identity(), std::nullopt});
  CHECK_THROWS_AS(absolute_errors(matched, Alignment::kSe3), pago::Error);
}

TEST_CASE("yaw is followed through full turns", "[evaluation][motion]") {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i <= 100; ++i) poses.push_back(planar(0, 0, 1.0 + 0.1 * i));   // ten radians to the left
  for (int i = 0; i <= 150; ++i) poses.push_back(planar(0, 0, 11.0 - 0.1 * i));  // and fifteen back
  CHECK(motion_of(poses).yaw_range_rad == Approx(15.0));
  CHECK(motion_of(poses).path_length_m == 0.0);
}

TEST_CASE("length, end and furthest point of a path there and half back", "[evaluation][motion]") {
  std::vector<Eigen::Isometry3d> poses;
  for (const double x_m : {5.0, 6.0, 9.0, 7.0}) poses.push_back(planar(x_m, 0, 0));
  const Motion motion = motion_of(poses);
  CHECK(motion.path_length_m == Approx(6.0));
  CHECK(motion.furthest_m == Approx(4.0));
  CHECK(motion.end_m == Approx(2.0));
  CHECK(motion_of({}).path_length_m == 0.0);
}

}  // namespace
