// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/mix_ups.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/paths.hpp"
#include "pago/core/se3.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

namespace {

using namespace pago;
using namespace pago::evaluation;
using namespace pago::test;
using Catch::Matchers::Contains;

/// An odometry's errors on each motion: 1 cm and 0.05 degrees.
Trajectory odometry_of(const Trajectory& truth, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
  for (std::size_t i = 1; i < truth.poses.size(); ++i)
    poses.push_back(poses.back() * truth.poses[i - 1].T_world_sensor.inverse() *
                    truth.poses[i].T_world_sensor * random_motion(random, 0.006, 0.0009));
  return trajectory_of(poses, "odometry");
}

std::vector<MixUp> find(const Trajectory& truth, const Trajectory& estimate) {
  MatchOptions options{.matching = Matching::kRow};
  options.rows = RowRange{0, std::min(truth.poses.size(), estimate.poses.size()) - 1};
  return find_mix_ups(truth, estimate, options);
}

MixUp only(const std::vector<MixUp>& found) {
  for (const MixUp& mix_up : found) UNSCOPED_INFO(mix_up.sentence());
  REQUIRE(found.size() == 1);
  return found.front();
}

template <typename Change>
Trajectory changed(Trajectory trajectory, Change change) {
  for (StampedPose& pose : trajectory.poses) pose.T_world_sensor = change(pose.T_world_sensor);
  return trajectory;
}

/// Rows as seen `rows` later: what an estimate at another instant of the sweep, or off by rows, looks like.
Trajectory later(const Trajectory& trajectory, double rows) {
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    const double at = std::clamp(static_cast<double>(i) + rows, 0.0,
                                 static_cast<double>(trajectory.poses.size() - 1) - 1e-9);
    const auto k = static_cast<std::size_t>(at);
    poses.push_back(interpolate(trajectory.poses[k].T_world_sensor, trajectory.poses[k + 1].T_world_sensor,
                                at - static_cast<double>(k)));
  }
  return trajectory_of(poses, trajectory.name);
}

const Trajectory& truth() {
  static const Trajectory drive = town_drive(600, "truth");
  return drive;
}

TEST_CASE("a right estimate arouses no suspicion, whatever its noise", "[evaluation][mix_ups]") {
  for (unsigned seed = 1; seed <= 20; ++seed) CHECK(find(truth(), odometry_of(truth(), seed)).empty());
  CHECK(find(truth(), truth()).empty());
  // Nor does one that is bad: half a metre per motion, or 5 % too long.
  CHECK(find(truth(), drifting(truth(), 2)).empty());
  std::mt19937 random(3);
  CHECK(find(truth(), changed(odometry_of(truth()),
                              [&](const auto& T) { return T * random_motion(random, 0.2, 0.02); }))
            .empty());
  // Standing or hardly moving tells nothing.
  const Trajectory standing = chain(Eigen::Isometry3d::Identity(), 100, "standing");
  CHECK(find(standing, standing).empty());
  CHECK(find(chain(planar(0.01, 0, 0), 100, "slow"),
             changed(standing, [](const auto& T) { return T.inverse(); }))
            .empty());
}

TEST_CASE("another instant of the sweep is named with its size", "[evaluation][mix_ups]") {
  const Trajectory estimate = odometry_of(truth());
  for (const double rows : {0.5, -0.5, 1.0, -1.0, 3.0}) {
    const MixUp mix_up = only(find(later(truth(), rows), estimate));
    CHECK(mix_up.kind == MixUpKind::kTimeShift);
    CHECK(mix_up.amount == Approx(-rows).margin(0.12));
  }
  CHECK_THAT(only(find(later(truth(), 0.5), estimate)).evidence, Contains("middles"));
  CHECK_THAT(only(find(later(truth(), 1.0), estimate)).evidence, Contains("off by one"));
  CHECK_THAT(only(find(later(truth(), 3.0), estimate)).evidence, Contains("off by 3"));
}

TEST_CASE("a time farther off than was looked is said to be so", "[evaluation][mix_ups]") {
  const MixUp far = only(find(later(truth(), 9.0), odometry_of(truth())));
  CHECK(far.kind == MixUpKind::kTimeShift);
  CHECK_THAT(far.sentence(), Contains("as far as was looked: 5 rows"));
}

TEST_CASE("an odometry that is lost is not in another unit", "[evaluation][mix_ups]") {
  std::mt19937 random(5);
  Trajectory standing = truth();
  for (StampedPose& pose : standing.poses)
    pose.T_world_sensor = truth().poses.front().T_world_sensor * random_motion(random, 0.05, 0.001);
  for (const MixUp& mix_up : find(truth(), standing)) CHECK(mix_up.kind != MixUpKind::kScale);
}

TEST_CASE("two files in the camera's axes are named, too", "[evaluation][mix_ups]") {
  const Eigen::Isometry3d C = T_camera_sensor_axes();
  const auto to_camera = [&](const Eigen::Isometry3d& T) { return C * T * C.inverse(); };
  const MixUp both = only(find(changed(truth(), to_camera), changed(odometry_of(truth()), to_camera)));
  CHECK(both.kind == MixUpKind::kCameraFrame);
  CHECK_THAT(both.sentence(), Contains("--truth-frame camera --estimate-frame camera"));
}

TEST_CASE("camera poses taken for the sensor's are named", "[evaluation][mix_ups]") {
  const Trajectory estimate = odometry_of(truth());
  const Eigen::Isometry3d C = T_camera_sensor_axes();
  const auto to_camera = [&](const Eigen::Isometry3d& T) { return C * T * C.inverse(); };
  const MixUp of_truth = only(find(changed(truth(), to_camera), estimate));
  CHECK(of_truth.kind == MixUpKind::kCameraFrame);
  CHECK_THAT(of_truth.finding, Contains("The truth seems to hold poses of KITTI's camera"));
  CHECK_THAT(of_truth.remedy, Contains("--truth-frame camera"));
  const MixUp of_estimate = only(find(truth(), changed(estimate, to_camera)));
  CHECK(of_estimate.kind == MixUpKind::kCameraFrame);
  CHECK_THAT(of_estimate.remedy, Contains("--estimate-frame camera"));
}

TEST_CASE("a body that is turned or mounted apart is named with its mount", "[evaluation][mix_ups]") {
  const Trajectory estimate = odometry_of(truth());
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.2, -0.4, 1.0).normalized()));
  const MixUp turned = only(find(truth(), changed(estimate, [&](const auto& T) { return T * turn; })));
  CHECK(turned.kind == MixUpKind::kBodyTurned);
  CHECK(turned.amount == Approx(5.73).margin(0.2));
  const MixUp upside_down =
      only(find(truth(), changed(estimate, [&](const auto& T) {
                  return T * Eigen::Isometry3d(Eigen::AngleAxisd(3.14159, Eigen::Vector3d::UnitX()));
                })));
  CHECK(upside_down.kind == MixUpKind::kBodyTurned);
  CHECK(upside_down.amount == Approx(180).margin(1));

  const Eigen::Isometry3d lever(Eigen::Translation3d(1.5, -0.4, 0.9));
  const MixUp apart = only(find(truth(), changed(estimate, [&](const auto& T) { return T * lever; })));
  CHECK(apart.kind == MixUpKind::kBodyMoved);
  CHECK(apart.amount == Approx(1.6).margin(0.25));
  CHECK_THAT(apart.evidence, Contains("ahead") && Contains("-0.4"));
}

TEST_CASE("poses in the wrong order are named", "[evaluation][mix_ups]") {
  const Trajectory estimate = odometry_of(truth());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) names.push_back(std::to_string(i));
  std::sort(names.begin(), names.end());
  Trajectory as_words = estimate, backwards = estimate;
  as_words.name = "as_words.txt";
  for (std::size_t i = 0; i < names.size(); ++i) {
    as_words.poses[i].T_world_sensor = estimate.poses[std::stoul(names[i])].T_world_sensor;
    backwards.poses[i].T_world_sensor = estimate.poses[names.size() - 1 - i].T_world_sensor;
  }
  const MixUp words = only(find(truth(), as_words));
  CHECK(words.kind == MixUpKind::kUnsorted);
  CHECK_THAT(words.sentence(), Contains("as_words.txt") && Contains("order of words"));
  CHECK(only(find(as_words, truth())).kind == MixUpKind::kUnsorted);
  CHECK(only(find(truth(), backwards)).kind == MixUpKind::kReversed);
}

TEST_CASE("inverted poses, a scalar in front, mirrored axes and wrong units are named",
          "[evaluation][mix_ups]") {
  const Trajectory estimate = odometry_of(truth());
  CHECK(only(find(truth(), changed(estimate, [](const auto& T) { return T.inverse(); }))).kind ==
        MixUpKind::kInverted);
  CHECK(only(find(truth(), changed(estimate,
                                   [](const Eigen::Isometry3d& T) {
                                     const Eigen::Quaterniond q(T.linear());
                                     Eigen::Isometry3d read = T;  // the file says w x y z, read as x y z w
                                     read.linear() =
                                         Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
                                     return read;
                                   })))
            .kind == MixUpKind::kQuaternionOrder);
  CHECK(only(find(truth(), changed(estimate,
                                   [](const Eigen::Isometry3d& T) {
                                     const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, 1).asDiagonal();
                                     Eigen::Isometry3d mirrored = Eigen::Isometry3d::Identity();
                                     mirrored.linear() = flip * T.linear() * flip;
                                     mirrored.translation() = flip * T.translation();
                                     return mirrored;
                                   })))
            .kind == MixUpKind::kMirrored);
  const MixUp millimetres = only(find(truth(), changed(estimate, [](Eigen::Isometry3d T) {
                                        T.translation() *= 1000.0;
                                        return T;
                                      })));
  CHECK(millimetres.kind == MixUpKind::kScale);
  CHECK(millimetres.amount == Approx(1000).epsilon(0.01));
}

TEST_CASE("published trajectories are right as they are, and each mix-up of them is found",
          "[evaluation][mix_ups]") {
  PAGO_DATA_OR_SKIP(kitti, "kitti/results/simple_online");
  for (const char* sequence : {"00.txt", "03.txt", "07.txt"}) {
    INFO(sequence);
    Trajectory truth = read_trajectory(kitti / "../../poses" / sequence);
    Trajectory estimate = read_trajectory(kitti / sequence);
    const Trajectory in_camera = estimate;
    for (Trajectory* trajectory : {&truth, &estimate}) camera_to_sensor(*trajectory, T_camera_sensor_axes());
    CHECK(find(truth, estimate).empty());
    CHECK(only(find(truth, in_camera)).kind == MixUpKind::kCameraFrame);
    CHECK(only(find(later(truth, 0.5), estimate)).amount == Approx(-0.5).margin(0.2));
    Trajectory without_first = estimate;
    without_first.poses.erase(without_first.poses.begin());
    CHECK(only(find(truth, without_first)).amount == Approx(1.0).margin(0.3));
  }
}

}  // namespace
