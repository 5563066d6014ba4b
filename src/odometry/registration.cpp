// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/registration/robust.hpp"

namespace pago::odometry {

using registration::geman_mcclure;

namespace {

// Degrees of freedom in the order x y z roll pitch yaw.
constexpr std::array<int, 3> kStepOne{2, 3, 4};
constexpr std::array<int, 3> kStepTwo{0, 1, 5};

Match match_of(const Eigen::Vector3d& source, const Plane& plane, const OdometryConfig& config) noexcept {
  return {source, plane.centre, plane.normal, plane.variance_m2 + config.point_sigma_m * config.point_sigma_m};
}
Match match_of(const Eigen::Vector3d& source, const Line& line, const OdometryConfig& config) noexcept {
  return {source, line.centre, line.direction, line.variance_m2 + config.edge_sigma_m * config.edge_sigma_m};
}

}  // namespace

TwoStepRegistration::TwoStepRegistration(const OdometryConfig& config, std::size_t max_sources)
    : config_(config),
      deskewed_(max_sources),
      ground_(max_sources),
      edges_(max_sources),
      walls_(max_sources),
      residuals_(max_sources) {}

RegistrationResult TwoStepRegistration::align(const FeatureSet& sources,
                                              Targets& targets,
                                              const Eigen::Isometry3d& T_guess,
                                              double period_s,
                                              double match_radius_m) noexcept {
  T_ = T_guess;
  const auto ground = [&](const Eigen::Vector3d& query) { return targets.find_ground(query, match_radius_m); };
  const auto wall = [&](const Eigen::Vector3d& query) { return targets.find_wall(query, match_radius_m); };
  const auto edge = [&](const Eigen::Vector3d& query) { return targets.find_edge(query, match_radius_m); };
  RegistrationResult result;
  for (; result.rounds < config_.max_rounds; ++result.rounds) {
    const Eigen::Isometry3d T_before = T_;
    deskew_sources(sources, period_s);

    match(deskewed_.ground, ground, ground_);
    for (int i = 0; i < config_.steps_per_round; ++i) {
      NormalEquations sum;
      accumulate(ground_, Shape::kPlane, sum);
      step(sum, kStepOne);
    }

    match(deskewed_.edges, edge, edges_);
    if (config_.walls_in_step_two) match(deskewed_.walls, wall, walls_);
    for (int i = 0; i < config_.steps_per_round; ++i) {
      NormalEquations sum;
      accumulate(edges_, Shape::kLine, sum);
      accumulate(walls_, Shape::kPlane, sum);
      step(sum, kStepTwo);
    }

    const Vector6d moved = log_se3(T_before.inverse() * T_);
    if (moved.head<3>().norm() < config_.stop_translation_m &&
        moved.tail<3>().norm() < config_.stop_rotation_rad)
      break;
  }
  finish(sources, result);
  return result;
}

void TwoStepRegistration::deskew_sources(const FeatureSet& sources, double period_s) noexcept {
  Vector6d twist = Vector6d::Zero();
  if (period_s > 0.0 && config_.deskew) twist = log_se3(T_) / period_s;
  deskew(sources.edges, twist, deskewed_.edges);
  deskew(sources.ground, twist, deskewed_.ground);
  deskew(sources.walls, twist, deskewed_.walls);
}

template <typename Find>
void TwoStepRegistration::match(const PointCloud& cloud, Find find, Matches& out) noexcept {
  out.clear();
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d source = cloud.point(i).cast<double>();
    if (const auto found = find(T_ * source)) out.push_back(match_of(source, *found, config_));
  }
}

double TwoStepRegistration::residual(const Match& match, Shape shape) const noexcept {
  const Eigen::Vector3d offset = T_ * match.source - match.centre;
  return shape == Shape::kPlane ? match.axis.dot(offset) : match.axis.cross(offset).norm();
}

double TwoStepRegistration::kernel_width(const Matches& matches, Shape shape) noexcept {
  residuals_.clear();
  for (const Match& match : matches) residuals_.push_back(std::abs(residual(match, shape)));
  return registration::kernel_width<double>({residuals_.begin(), residuals_.size()}, config_.kernel_min_m);
}

// With the perturbation T exp(d), d = (v, w), a plane's n . (T p) changes by m . v + (p x m) . w, m = R^T n; a
// line's offset, seen across its direction in the sensor frame, by P v - P [p]x w.
void TwoStepRegistration::accumulate(const Matches& matches, Shape shape, NormalEquations& sum) noexcept {
  const double width = kernel_width(matches, shape);
  const Eigen::Matrix3d R_source_target = T_.linear().transpose();
  for (const Match& match : matches) {
    const Eigen::Vector3d axis = R_source_target * match.axis;
    const Eigen::Vector3d offset = R_source_target * (T_ * match.source - match.centre);
    if (shape == Shape::kPlane) {
      const double r = axis.dot(offset);
      const double weight = geman_mcclure(r, width) / match.variance_m2;
      Vector6d J;
      J << axis, match.source.cross(axis);
      sum.H.noalias() += weight * J * J.transpose();
      sum.b.noalias() += weight * r * J;
      sum.weight += weight, sum.weighted_sq += weight * r * r;
    } else {
      const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - axis * axis.transpose();
      const Eigen::Vector3d r = P * offset;
      const double weight = geman_mcclure(r.norm(), width) / match.variance_m2;
      Eigen::Matrix<double, 3, 6> J;
      J << P, -P * hat(match.source);
      sum.H.noalias() += weight * J.transpose() * J;
      sum.b.noalias() += weight * J.transpose() * r;
      sum.weight += weight, sum.weighted_sq += weight * r.squaredNorm();
    }
  }
}

void TwoStepRegistration::step(const NormalEquations& sum, const std::array<int, 3>& dofs) noexcept {
  Eigen::Matrix3d H;
  Eigen::Vector3d b;
  for (int i = 0; i < 3; ++i) {
    const int di = dofs[static_cast<std::size_t>(i)];
    b[i] = sum.b[di];
    for (int j = 0; j < 3; ++j) H(i, j) = sum.H(di, dofs[static_cast<std::size_t>(j)]);
  }
  // Directions without information stay where the prediction put them.
  H.diagonal().array() += 1e-6;
  const Eigen::Vector3d solution = H.ldlt().solve(-b) * config_.update_gain;
  if (!solution.allFinite()) return;
  Vector6d delta = Vector6d::Zero();
  for (int i = 0; i < 3; ++i) delta[dofs[static_cast<std::size_t>(i)]] = solution[i];
  T_ = perturb(T_, delta);
}

// With a fixed kernel: the one used for solving widens with the misfit, and so would praise a bad fit.
double TwoStepRegistration::support(const Matches& matches, Shape shape, std::size_t offered) const noexcept {
  constexpr double kWidth_m = 0.1;
  double sum = 0.0;
  for (const Match& match : matches) sum += geman_mcclure(residual(match, shape), kWidth_m);
  return sum / static_cast<double>(std::max<std::size_t>(1, offered));
}

void TwoStepRegistration::finish(const FeatureSet& sources, RegistrationResult& result) noexcept {
  NormalEquations ground, two;
  accumulate(ground_, Shape::kPlane, ground);
  accumulate(edges_, Shape::kLine, two);
  if (config_.walls_in_step_two) accumulate(walls_, Shape::kPlane, two);

  T_.linear() = Eigen::Quaterniond(T_.linear()).normalized().toRotationMatrix();
  result.T_target_source = T_;
  result.ground_matches = static_cast<std::uint32_t>(ground_.size());
  result.edge_matches = static_cast<std::uint32_t>(edges_.size());
  result.wall_matches = static_cast<std::uint32_t>(walls_.size());
  result.ground_rms_m = ground.rms_m();
  result.edge_rms_m = two.rms_m();
  result.score =
      support(edges_, Shape::kLine, sources.edges.size) + support(walls_, Shape::kPlane, sources.walls.size);
  result.information = ground.H + two.H;
}

}  // namespace pago::odometry
