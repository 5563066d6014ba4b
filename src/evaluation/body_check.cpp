// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/SVD>
#include <cmath>

#include "motions.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

constexpr double kSmallestBodyGain = 0.5;
constexpr double kSmallestTurnDeg = 1.0;
constexpr double kSmallestLever_m = 0.1;
constexpr double kCameraWithinDeg = 10.0;
// A rotation of 1 rad counts as much as a translation of so many metres: about as far as the walls that fix
// the rotation are.
constexpr double kMetresPerRad = 10.0;

/// R_truth_estimate between the two bodies, from a least-squares fit of the motions (Kabsch 1976).
Eigen::Matrix3d turn_between(const std::vector<MotionPair>& pairs) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (const auto& [truth, estimate] : pairs) {
    H += estimate.translation_m * truth.translation_m.transpose();
    H += kMetresPerRad * kMetresPerRad * estimate.rotation_rad * truth.rotation_rad.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d R = svd.matrixV() * svd.matrixU().transpose();
  if (R.determinant() < 0.0) {
    Eigen::Matrix3d V = svd.matrixV();
    V.col(2) = -V.col(2);
    R = V * svd.matrixU().transpose();
  }
  return R;
}

std::vector<MotionPair> turned(std::vector<MotionPair> pairs, const Eigen::Matrix3d& R_truth_estimate) {
  for (MotionPair& pair : pairs) {
    pair.estimate.translation_m = R_truth_estimate * pair.estimate.translation_m;
    pair.estimate.rotation_rad = R_truth_estimate * pair.estimate.rotation_rad;
  }
  return pairs;
}

/// Where the estimate's body sits in the truth's, once both look the same way: a point at `lever` moves by
/// (R - I) lever more than the body itself. Directions that no turn shows come out as zero.
Eigen::Vector3d lever_between(const std::vector<MotionPair>& pairs) {
  Eigen::Matrix3d A = 1e-3 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const auto& [truth, estimate] : pairs) {
    const Eigen::Matrix3d turn = exp_so3(truth.rotation_rad) - Eigen::Matrix3d::Identity();
    A += turn.transpose() * turn;
    b += turn.transpose() * (estimate.translation_m - truth.translation_m);
  }
  return A.inverse() * b;
}

std::vector<MotionPair> moved(std::vector<MotionPair> pairs, const Eigen::Vector3d& lever_m) {
  for (MotionPair& pair : pairs)
    pair.estimate.translation_m -= exp_so3(pair.truth.rotation_rad) * lever_m - lever_m;
  return pairs;
}

double angle_deg(const Eigen::Matrix3d& R) {
  return log_so3(R).norm() * kDegPerRad;
}

std::string angles(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d rpy_deg = roll_pitch_yaw_rad(R) * kDegPerRad;
  return format("roll %.1f, pitch %.1f, yaw %.1f degrees", rpy_deg.x(), rpy_deg.y(), rpy_deg.z());
}

std::string less_error(const Misfit& before, const Misfit& after) {
  return format("with that their motions differ by %.0f %% less",
                100.0 * (1.0 - std::sqrt(after.translation_sq / before.translation_sq)));
}

MixUp turn_of(const Eigen::Matrix3d& R_truth_estimate, const std::string& fit) {
  const Eigen::Matrix3d R_camera_sensor = T_camera_sensor_axes().linear();
  const bool is_truth_camera = angle_deg(R_truth_estimate.transpose() * R_camera_sensor) < kCameraWithinDeg;
  const bool is_estimate_camera = angle_deg(R_truth_estimate * R_camera_sensor) < kCameraWithinDeg;
  const std::string evidence =
      "the estimate's body is turned against the truth's by " + angles(R_truth_estimate) + "; " + fit;
  if (is_truth_camera || is_estimate_camera) {
    const std::string which = is_truth_camera ? "truth" : "estimate";
    return {MixUpKind::kCameraFrame,
            "The " + which +
                " seems to hold poses of KITTI's camera (z forward), the other "
                "file poses of a sensor (x forward)",
            evidence, "Say so (--" + which + "-frame camera, with the calibration).",
            angle_deg(R_truth_estimate)};
  }
  return {MixUpKind::kBodyTurned,
          "The two files seem to hold poses of bodies that are turned against each other", evidence,
          "State the truth's mount (--truth-mount), or check the calibration.", angle_deg(R_truth_estimate)};
}

MixUp lever_of(const Eigen::Vector3d& lever_m, const std::string& fit) {
  return {MixUpKind::kBodyMoved, "The two files seem to hold poses of points that are mounted apart",
          format("the estimate's is %.2f m ahead and %.2f m to the left of the truth's; ", lever_m.x(),
                 lever_m.y()) +
              fit,
          "State the truth's mount (--truth-mount).", lever_m.norm()};
}

}  // namespace

std::vector<MixUp> find_body_mix_ups(const std::vector<MotionPair>& pairs) {
  std::vector<MixUp> found;
  const Misfit as_given = misfit_of(pairs);
  const Eigen::Matrix3d R_truth_estimate = turn_between(pairs);
  const std::vector<MotionPair> upright = turned(pairs, R_truth_estimate);
  const Misfit once_turned = misfit_of(upright);
  const bool is_turned = angle_deg(R_truth_estimate) > kSmallestTurnDeg &&
                         gain(as_given, once_turned, pairs.size()) > kSmallestBodyGain;
  if (is_turned) found.push_back(turn_of(R_truth_estimate, less_error(as_given, once_turned)));
  const std::vector<MotionPair>& level = is_turned ? upright : pairs;
  const Eigen::Vector3d lever_m = lever_between(level);
  const Misfit before = misfit_of(level), after = misfit_of(moved(level, lever_m));
  if (lever_m.norm() > kSmallestLever_m && gain(before, after, pairs.size()) > kSmallestBodyGain)
    found.push_back(lever_of(lever_m, less_error(before, after)));
  return found;
}

}  // namespace pago::evaluation
