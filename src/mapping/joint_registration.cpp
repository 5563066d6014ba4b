// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/joint_registration.hpp"

#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/registration/robust.hpp"

namespace pago::mapping {

using registration::Cell;
using registration::CellMap;
using registration::Deskew;
using registration::PointCloud;

namespace {

Vector6d twist_of(const Eigen::Isometry3d& T_last_this, const MotionGuess& guess) noexcept {
  if (guess.is_compensated || guess.period_s <= 0.0) return Vector6d::Zero();
  return log_se3(T_last_this) / guess.period_s;
}

}  // namespace

JointRegistration::JointRegistration(const MappingConfig& config, std::size_t max_points)
    : config_(config), matches_(max_points), magnitudes_(max_points) {}

JointResult JointRegistration::align(CellMap& map,
                                     const PointCloud& points,
                                     const MotionGuess& guess) noexcept {
  JointResult result;
  result.offered = static_cast<std::uint32_t>(points.size);
  result.T_last_this = guess.T_last_this;
  while (result.iterations < config_.max_iterations) {
    ++result.iterations;
    result.twist = twist_of(result.T_last_this, guess);
    match(map, points, guess.T_map_last * result.T_last_this, result.twist);
    const NormalEquations sum = accumulate();
    result.information = sum.H;
    result.matches = static_cast<std::uint32_t>(matches_.size());
    result.rms_m = sum.weight > 0.0 ? std::sqrt(sum.weighted_sq / sum.weight) : 0.0;
    if (matches_.size() < 6) break;

    const Vector6d off = difference(guess.T_last_this, result.T_last_this);
    const Vector6d step = solve_semidefinite(sum.H + guess.information, -(sum.b + guess.information * off));
    if (!step.allFinite()) break;
    result.T_last_this = perturb(result.T_last_this, step);
    if (step.head<3>().norm() < config_.stop_translation_m && step.tail<3>().norm() < config_.stop_rotation_rad)
      break;
  }
  result.T_last_this = orthonormalized(result.T_last_this);
  result.twist = twist_of(result.T_last_this, guess);
  return result;
}

void JointRegistration::match(CellMap& map,
                              const PointCloud& points,
                              const Eigen::Isometry3d& T_map_this,
                              const Vector6d& twist) noexcept {
  const Deskew to_reference(twist);
  const Eigen::Matrix3d R = T_map_this.linear();
  const Eigen::Matrix3f R_this_map = R.transpose().cast<float>();
  const auto gate_m = static_cast<float>(config_.gate_m);
  const auto sigma_sq = static_cast<float>(config_.point_sigma_m * config_.point_sigma_m);
  matches_.clear();
  for (std::size_t i = 0; i < points.size; ++i) {
    const Eigen::Vector3f p = to_reference(points.point(i), points.before_s[i]);
    const Eigen::Vector3d in_map = R * p.cast<double>() + T_map_this.translation();
    Eigen::Vector3f offset;
    const Cell* plane = map.find_shape(in_map, points.tag[i], offset);
    if (plane == nullptr) continue;
    const float residual = plane->axis.dot(offset);
    if (!(std::abs(residual) < gate_m)) continue;
    matches_.push_back({p, R_this_map * plane->axis, residual, sigma_sq + plane->thickness_m2});
  }
}

// With the perturbation T exp(d), d = (v, w), a plane's n . (T p) changes by m . v + (p x m) . w, m = R^T n.
JointRegistration::NormalEquations JointRegistration::accumulate() noexcept {
  magnitudes_.clear();
  for (const Match& match : matches_) magnitudes_.push_back(std::abs(match.residual_m));
  const float width = registration::kernel_width<float>({magnitudes_.begin(), magnitudes_.size()},
                                                        static_cast<float>(config_.kernel_min_m));
  NormalEquations sum;
  for (const Match& match : matches_) {
    const float weight = registration::geman_mcclure(match.residual_m, width) / match.variance_m2;
    const Eigen::Vector3f arm = match.point.cross(match.normal);
    Vector6d J;
    J << match.normal.cast<double>(), arm.cast<double>();
    const double w = weight, r = match.residual_m;
    sum.H.noalias() += w * J * J.transpose();
    sum.b.noalias() += w * r * J;
    sum.weight += w, sum.weighted_sq += w * r * r;
  }
  return sum;
}

}  // namespace pago::mapping
