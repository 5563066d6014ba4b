// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/joint_registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/core/sweep.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/registration/robust.hpp"

namespace pago::mapping {

using registration::BendEquations;
using registration::Cell;
using registration::CellMap;
using registration::Matrix12d;
using registration::NormalEquations;
using registration::PointCloud;
using registration::Row;
using registration::Vector12d;

namespace {

/// Fewer equations than unknowns say nothing.
constexpr std::size_t kLeastMatches = 6;

bool finds_bend(const MotionGuess& guess) noexcept {
  return guess.acceleration && guess.period_s > 0.0;
}

/// The motion within a sweep: what the motion since the last one makes expect, and the change that was found.
MotionInSweep within(const Eigen::Isometry3d& T_last_this,
                     const MotionGuess& guess,
                     const Vector12d& bend) noexcept {
  if (guess.period_s <= 0.0) return {};
  if (guess.twist) return {*guess.twist};
  const Vector6d since_last = log_se3(T_last_this) / guess.period_s;
  if (!guess.acceleration) return {since_last};
  return {since_last + 0.5 * guess.period_s * *guess.acceleration + bend.head<6>(),
          *guess.acceleration + bend.tail<6>()};
}

/// How well that is known from the last motions.
Matrix12d bend_information(const MappingConfig& config, const Vector6d& acceleration_sigma) noexcept {
  Vector12d sigma;
  sigma.segment<3>(0).setConstant(config.twist_sigma_m_s);
  sigma.segment<3>(3).setConstant(config.twist_sigma_rad_s);
  sigma.tail<6>() = acceleration_sigma;
  return sigma.cwiseAbs2().cwiseInverse().asDiagonal();
}

/// The bend that solves its equations: `alone` if the motion stays, and what each change of the motion adds.
struct BendStep {
  Vector12d alone = Vector12d::Zero();
  Eigen::Matrix<double, 12, 6> per_motion = Eigen::Matrix<double, 12, 6>::Zero();
};
BendStep step_of(const BendEquations& bends, const Matrix12d& known, const Vector12d& bend) noexcept {
  const Eigen::LLT<Matrix12d> system(bends.bend_bend + known);
  return {-system.solve(bends.b + known * bend), -system.solve(bends.motion_bend.transpose())};
}

}  // namespace

JointRegistration::JointRegistration(const MappingConfig& config, std::size_t max_points)
    : config_(config), rows_(max_points), before_s_(max_points), magnitudes_(max_points) {}

JointResult JointRegistration::align(CellMap& map,
                                     const PointCloud& points,
                                     const MotionGuess& guess,
                                     const JointLimits& limits,
                                     const Budget& budget) noexcept {
  JointResult result;
  result.offered = static_cast<std::uint32_t>((points.size + limits.stride - 1) / limits.stride);
  result.T_last_this = limits.T_first.value_or(guess.T_last_this);
  const Matrix12d known_bend = bend_information(config_, guess.acceleration_sigma);
  Vector12d bend = Vector12d::Zero();
  while (true) {
    result.within = within(result.T_last_this, guess, bend);
    match(map, points, guess.T_map_last * result.T_last_this, result.within, limits);
    weigh(limits.kernel_min_m);
    const NormalEquations sum = equations_.sum();
    ++result.iterations;
    result.information = sum.H;
    result.rms_m = sum.rms_m();
    // Judged where the search begins: afterwards it could have slipped along what is weak.
    if (result.iterations == 1 && limits.keeps_weak) {
      result.weak = registration::find_weak_directions(sum.H, rows_.view(), config_.min_contribution);
      result.doubted =
          registration::find_weak_directions(sum.H, rows_.view(), config_.trust.min_contribution);
    }
    if (rows_.size() < kLeastMatches) break;

    const Vector6d off = difference(guess.T_last_this, result.T_last_this);
    Matrix6d H = sum.H + guess.information + result.weak.penalty;
    Vector6d b = sum.b + guess.information * off;
    BendStep bend_step;
    if (finds_bend(guess)) {  // eliminated: what is left are the equations of the motion
      const BendEquations bends = equations_.bends();
      bend_step = step_of(bends, known_bend, bend);
      const Matrix6d lost = bends.motion_bend * bend_step.per_motion;
      H += lost;
      b += bends.motion_bend * bend_step.alone;
      result.information += lost;
    }
    const Vector6d step = solve_semidefinite(H, -b);
    if (!step.allFinite()) break;
    bend += bend_step.alone + bend_step.per_motion * step;
    result.T_last_this = perturb(result.T_last_this, step);
    if (step.head<3>().norm() < config_.stop_translation_m &&
        step.tail<3>().norm() < config_.stop_rotation_rad)
      break;
    if (result.iterations >= limits.max_iterations) break;
    result.is_cut = !budget.allows_after(result.iterations);
    if (result.is_cut) break;
  }
  result.T_last_this = orthonormalized(result.T_last_this);
  result.within = within(result.T_last_this, guess, bend);
  measure(result);
  return result;
}

void JointRegistration::match(CellMap& map,
                              const PointCloud& points,
                              const Eigen::Isometry3d& T_map_this,
                              const MotionInSweep& motion,
                              const JointLimits& limits) noexcept {
  const Deskew to_reference(motion);
  const Eigen::Matrix3d R = T_map_this.linear();
  const Eigen::Vector3d t = T_map_this.translation();
  const Eigen::Matrix3f R_this_map = R.transpose().cast<float>();
  const auto gate_m = static_cast<float>(limits.gate_m);
  const auto sigma_sq = static_cast<float>(config_.point_sigma_m * config_.point_sigma_m);
  rows_.clear();
  before_s_.clear();
  for (std::size_t i = 0; i < points.size; ++i) {
    const bool may_be_left_out = !limits.thins_ground_only || points.tag[i] == kGround;
    if (may_be_left_out && i % limits.stride != 0) continue;
    const Eigen::Vector3f p = to_reference(points.point(i), points.before_s[i]);
    Eigen::Vector3f offset;
    const Cell* plane = map.find_shape(R * p.cast<double>() + t, points.tag[i], offset);
    if (plane == nullptr) continue;
    const float residual = plane->axis.dot(offset);
    if (!(std::abs(residual) < gate_m)) continue;
    rows_.push_back(
        registration::plane_row(p, R_this_map * plane->axis, residual, sigma_sq + plane->thickness_m2));
    before_s_.push_back(points.before_s[i]);
  }
}

void JointRegistration::weigh(double kernel_min_m) noexcept {
  magnitudes_.clear();
  for (const Row& row : rows_) magnitudes_.push_back(std::abs(row.residual_m));
  const float width = registration::kernel_width<float>({magnitudes_.begin(), magnitudes_.size()},
                                                        static_cast<float>(kernel_min_m));
  equations_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    row.kernel_weight = registration::geman_mcclure(row.residual_m, width);
    equations_.add(row, before_s_[i]);
  }
}

// With a fixed kernel: the one used for solving widens with the misfit, and so would praise a bad fit.
void JointRegistration::measure(JointResult& result) const noexcept {
  constexpr float kWidth_m = 0.1F;
  double closeness = 0.0;
  for (const Row& row : rows_.view())
    closeness += static_cast<double>(registration::geman_mcclure(row.residual_m, kWidth_m));
  result.matches = static_cast<std::uint32_t>(rows_.size());
  result.score = closeness / std::max(1U, result.offered);
}

}  // namespace pago::mapping
