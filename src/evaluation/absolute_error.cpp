// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/absolute_error.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/evaluation/statistics.hpp"
#include "rotation.hpp"

namespace pago::evaluation {
namespace {

struct PosePair {
  Eigen::Isometry3d truth, estimate;
};

std::vector<PosePair> pairs_of(const MatchedTrajectories& matched) {
  std::vector<PosePair> pairs;
  for (const MatchedPose& pose : matched.poses)
    if (pose.T_world_sensor_estimate)
      pairs.push_back({pose.T_world_sensor_truth, *pose.T_world_sensor_estimate});
  if (pairs.empty()) throw Error("evaluation", "no pose of the estimate belongs to one of the truth");
  return pairs;
}

/// Positions as columns, so that Eigen's Umeyama and the yaw fit read the same.
struct Positions {
  Eigen::Matrix3Xd truth, estimate;
};

Positions positions_of(const std::vector<PosePair>& pairs) {
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Positions positions{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    positions.truth.col(i) = pairs[static_cast<std::size_t>(i)].truth.translation();
    positions.estimate.col(i) = pairs[static_cast<std::size_t>(i)].estimate.translation();
  }
  return positions;
}

Eigen::Isometry3d align_se3(const Positions& positions) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.matrix() = Eigen::umeyama(positions.estimate, positions.truth, /*with_scaling=*/false);
  return T;
}

/// Maximises sum of truth . Rz(yaw) estimate over the centred positions.
Eigen::Isometry3d align_yaw(const Positions& positions) {
  const Eigen::Vector3d mean_truth = positions.truth.rowwise().mean();
  const Eigen::Vector3d mean_estimate = positions.estimate.rowwise().mean();
  const Eigen::Matrix3Xd truth = positions.truth.colwise() - mean_truth;
  const Eigen::Matrix3Xd estimate = positions.estimate.colwise() - mean_estimate;
  const double along = (estimate.row(0).dot(truth.row(0))) + (estimate.row(1).dot(truth.row(1)));
  const double across = (estimate.row(0).dot(truth.row(1))) - (estimate.row(1).dot(truth.row(0)));
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()));
  T.translation() = mean_truth - T.linear() * mean_estimate;
  return T;
}

Eigen::Isometry3d align_pairs(const std::vector<PosePair>& pairs, Alignment alignment) {
  switch (alignment) {
    case Alignment::kSe3:
      return align_se3(positions_of(pairs));
    case Alignment::kYaw:
      return align_yaw(positions_of(pairs));
    case Alignment::kFirstPose:
      return pairs.front().truth * pairs.front().estimate.inverse();
    default:
      return Eigen::Isometry3d::Identity();
  }
}

}  // namespace

std::string_view to_string(Alignment alignment) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(Alignment::kCount)> kWords{
      "SE(3)", "yaw and position", "first pose", "none"};
  return kWords[static_cast<std::size_t>(alignment)];
}

Eigen::Isometry3d align(const MatchedTrajectories& matched, Alignment alignment) {
  return align_pairs(pairs_of(matched), alignment);
}

AbsoluteErrors absolute_errors(const MatchedTrajectories& matched, Alignment alignment) {
  const std::vector<PosePair> pairs = pairs_of(matched);
  AbsoluteErrors errors;
  errors.alignment = alignment;
  errors.T_truth_estimate = align_pairs(pairs, alignment);

  std::vector<double> distances_m;
  Eigen::Vector3d sum_axis_sq = Eigen::Vector3d::Zero(), sum_rpy_sq = Eigen::Vector3d::Zero();
  double sum_angle_sq = 0.0;
  for (const PosePair& pair : pairs) {
    const Eigen::Isometry3d aligned = errors.T_truth_estimate * pair.estimate;
    const Eigen::Vector3d difference_m = aligned.translation() - pair.truth.translation();
    const Eigen::Matrix3d turned = pair.truth.linear().transpose() * aligned.linear();
    distances_m.push_back(difference_m.norm());
    sum_axis_sq += difference_m.cwiseAbs2();
    sum_rpy_sq += roll_pitch_yaw_rad(turned).cwiseAbs2();
    sum_angle_sq += log_so3(turned).squaredNorm();
  }
  const double n = static_cast<double>(pairs.size());
  const Statistics distance_m = statistics_of(distances_m);
  errors.rmse_m = distance_m.rmse;
  errors.mean_m = distance_m.mean;
  errors.median_m = distance_m.median;
  errors.deviation_m = distance_m.deviation;
  errors.min_m = distance_m.min;
  errors.max_m = distance_m.max;
  errors.axis_rmse_m = (sum_axis_sq / n).cwiseSqrt();
  errors.rotation_rmse_rad = std::sqrt(sum_angle_sq / n);
  errors.axis_rotation_rmse_rad = (sum_rpy_sq / n).cwiseSqrt();
  return errors;
}

}  // namespace pago::evaluation
