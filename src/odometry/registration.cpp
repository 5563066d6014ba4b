// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/registration/robust.hpp"

namespace pago::odometry {

using registration::plane_row;
using registration::Row;

namespace {

// Degrees of freedom in the order x y z roll pitch yaw.
constexpr std::array<int, 3> kStepOne{2, 3, 4};
constexpr std::array<int, 3> kStepTwo{0, 1, 5};

Match match_of(const Eigen::Vector3d& source, const Plane& plane, const OdometryConfig& config) noexcept {
  return {source, plane.centre, plane.normal,
          plane.variance_m2 + config.point_sigma_m * config.point_sigma_m};
}
Match match_of(const Eigen::Vector3d& source, const Line& line, const OdometryConfig& config) noexcept {
  return {source, line.centre, line.direction, line.variance_m2 + config.edge_sigma_m * config.edge_sigma_m};
}

/// LOAM's code: less the farther off, for planes by the square root of the range; too far off: nothing.
float loam_weight(float residual_m, float range_m, bool is_plane) noexcept {
  constexpr float kSlope = 1.8F, kLeast = 0.1F;
  const float weight = 1.0F - kSlope * residual_m / (is_plane ? std::sqrt(range_m) : 1.0F);
  return weight > kLeast ? weight : 0.0F;
}

}  // namespace

TwoStepRegistration::TwoStepRegistration(const OdometryConfig& config, std::size_t max_sources)
    : config_(config),
      deskewed_(max_sources),
      ground_(max_sources),
      edges_(max_sources),
      walls_(max_sources),
      rows_(4 * max_sources),
      ranges_m_(max_sources),
      magnitudes_(max_sources) {}

RegistrationResult TwoStepRegistration::align(const FeatureSet& sources,
                                              Targets& targets,
                                              const Eigen::Isometry3d& T_guess,
                                              double period_s) noexcept {
  T_ = T_guess;
  RegistrationResult result;
  for (round_ = 0; round_ < config_.max_rounds; ++round_) {
    const Eigen::Isometry3d T_before = T_;
    deskew_sources(sources, period_s);
    match_step_one(targets);
    if (round_ == 0) {  // where the search begins: afterwards it could have slipped along what is weak
      match_step_two(targets);
      finish(result);
    }
    for (int i = 0; i < config_.steps_per_round; ++i) {
      rows_.clear();
      add_rows(ground_, Shape::kPlane);
      solve(kStepOne, result.weak.penalty);
    }
    match_step_two(targets);
    for (int i = 0; i < config_.steps_per_round; ++i) {
      rows_.clear();
      add_rows(edges_, Shape::kLine);
      add_rows(walls_, Shape::kPlane);
      solve(kStepTwo, result.weak.penalty);
    }
    const Vector6d moved = difference(T_before, T_);
    if (moved.head<3>().norm() < config_.stop_translation_m &&
        moved.tail<3>().norm() < config_.stop_rotation_rad)
      break;
  }
  const registration::WeakDirections weak = result.weak;
  finish(result);
  result.weak = weak;
  result.information = weak.without(result.information);
  result.rounds = std::min(round_ + 1, config_.max_rounds);
  return result;
}

void TwoStepRegistration::deskew_sources(const FeatureSet& sources, double period_s) noexcept {
  Vector6d twist = Vector6d::Zero();
  if (period_s > 0.0 && config_.deskew) twist = log_se3(T_) / period_s;
  deskew(sources.edges, twist, deskewed_.edges);
  deskew(sources.ground, twist, deskewed_.ground);
  deskew(sources.walls, twist, deskewed_.walls);
}

void TwoStepRegistration::match_step_one(Targets& targets) noexcept {
  match(
      deskewed_.ground, [&](const Eigen::Vector3d& query) { return targets.find_ground(query); }, ground_);
}

void TwoStepRegistration::match_step_two(Targets& targets) noexcept {
  match(
      deskewed_.edges, [&](const Eigen::Vector3d& query) { return targets.find_edge(query); }, edges_);
  if (config_.walls_in_step_two)
    match(
        deskewed_.walls, [&](const Eigen::Vector3d& query) { return targets.find_wall(query); }, walls_);
}

template <typename Find>
void TwoStepRegistration::match(const PointCloud& cloud, Find find, Matches& out) noexcept {
  out.clear();
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d source = cloud.point(i).cast<double>();
    if (const auto found = find(T_ * source)) out.push_back(match_of(source, *found, config_));
  }
}

// An edge makes two rows: its offset along two directions across the line.
void TwoStepRegistration::add_rows(const Matches& matches, Shape shape) noexcept {
  const std::size_t begin = rows_.size();
  ranges_m_.clear();
  const Eigen::Matrix3d R_source_target = T_.linear().transpose();
  for (const Match& match : matches) {
    const Eigen::Vector3f source = match.source.cast<float>();
    const Eigen::Vector3f axis = (R_source_target * match.axis).cast<float>();
    const Eigen::Vector3f offset = (R_source_target * (T_ * match.source - match.centre)).cast<float>();
    const auto variance = static_cast<float>(match.variance_m2);
    ranges_m_.push_back(source.norm());
    if (shape == Shape::kPlane) {
      rows_.push_back(plane_row(source, axis, axis.dot(offset), variance));
    } else {
      const Eigen::Vector3f across = axis.unitOrthogonal(), other = axis.cross(across);
      rows_.push_back(plane_row(source, across, across.dot(offset), variance));
      rows_.push_back(plane_row(source, other, other.dot(offset), variance));
    }
  }
  weigh({rows_.begin() + begin, rows_.size() - begin}, shape);
}

void TwoStepRegistration::weigh(std::span<Row> rows, Shape shape) noexcept {
  const std::size_t per_match = shape == Shape::kPlane ? 1 : 2;
  const auto magnitude = [&](std::size_t i) {
    return per_match == 1 ? std::abs(rows[i].residual_m)
                          : std::hypot(rows[i].residual_m, rows[i + 1].residual_m);
  };
  magnitudes_.clear();
  for (std::size_t i = 0; i < rows.size(); i += per_match) magnitudes_.push_back(magnitude(i));
  const float width = registration::kernel_width<float>({magnitudes_.begin(), magnitudes_.size()},
                                                        static_cast<float>(config_.kernel_min_m));
  for (std::size_t i = 0; i < rows.size(); i += per_match) {
    float weight = 1.0F;
    if (config_.kernel == Kernel::kGemanMcClure) {
      weight = registration::geman_mcclure(magnitude(i), width);
    } else if (round_ > 0) {
      weight = loam_weight(magnitude(i), ranges_m_[i / per_match], shape == Shape::kPlane);
    }
    for (std::size_t k = 0; k < per_match; ++k) rows[i + k].kernel_weight = weight;
  }
}

void TwoStepRegistration::solve(const std::array<int, 3>& dofs, const Matrix6d& penalty) noexcept {
  NormalEquations sum;
  sum.add(rows_.view());
  sum.H += penalty;
  Eigen::Matrix3d H;
  Eigen::Vector3d b;
  for (int i = 0; i < 3; ++i) {
    const int di = dofs[static_cast<std::size_t>(i)];
    b[i] = sum.b[di];
    for (int j = 0; j < 3; ++j) H(i, j) = sum.H(di, dofs[static_cast<std::size_t>(j)]);
  }
  H.diagonal().array() += 1e-6;  // without any information: no step
  const Eigen::Vector3d solution = H.ldlt().solve(-b) * config_.update_gain;
  if (!solution.allFinite()) return;
  Vector6d delta = Vector6d::Zero();
  for (int i = 0; i < 3; ++i) delta[dofs[static_cast<std::size_t>(i)]] = solution[i];
  T_ = perturb(T_, delta);
}

void TwoStepRegistration::finish(RegistrationResult& result) noexcept {
  rows_.clear();
  add_rows(ground_, Shape::kPlane);
  NormalEquations one, two;
  one.add(rows_.view());
  const std::size_t ground_rows = rows_.size();
  add_rows(edges_, Shape::kLine);
  add_rows(walls_, Shape::kPlane);
  two.add(rows_.view().subspan(ground_rows));

  T_ = orthonormalized(T_);
  result.T_target_source = T_;
  result.ground_matches = static_cast<std::uint32_t>(ground_.size());
  result.edge_matches = static_cast<std::uint32_t>(edges_.size());
  result.wall_matches = static_cast<std::uint32_t>(walls_.size());
  result.ground_rms_m = one.rms_m();
  result.edge_rms_m = two.rms_m();
  result.information = one.H + two.H;
  result.weak =
      registration::find_weak_directions(result.information, rows_.view(), config_.min_contribution);
}

}  // namespace pago::odometry
