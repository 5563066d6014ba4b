// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"

namespace pago::odometry {

namespace {

// Degrees of freedom in the order x y z roll pitch yaw.
constexpr std::array<int, 3> kStepOne{2, 3, 4};
constexpr std::array<int, 3> kStepTwo{0, 1, 5};

double geman_mcclure(double residual, double width) noexcept {
  const double ratio = width * width / (width * width + residual * residual);
  return ratio * ratio;
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
                                              const TargetSet& targets,
                                              const Eigen::Isometry3d& T_guess,
                                              double period_s,
                                              double match_radius_m) noexcept {
  T_ = T_guess;
  const auto radius_m = static_cast<float>(match_radius_m);
  RegistrationResult result;
  for (; result.rounds < config_.max_rounds; ++result.rounds) {
    const Eigen::Isometry3d T_before = T_;
    deskew_sources(sources, period_s);

    match(deskewed_.ground, targets.ground, Shape::kPlane, radius_m, ground_);
    for (int i = 0; i < config_.steps_per_round; ++i) {
      NormalEquations sum;
      accumulate(ground_, Shape::kPlane, sum);
      step(sum, kStepOne);
    }

    match(deskewed_.edges, targets.edges, Shape::kLine, radius_m, edges_);
    if (config_.walls_in_step_two) match(deskewed_.walls, targets.walls, Shape::kPlane, radius_m, walls_);
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

void TwoStepRegistration::match(
    const FeatureCloud& cloud, const GridIndex& target, Shape shape, float radius_m, Matches& out) noexcept {
  out.clear();
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d source = cloud.point(i).cast<double>();
    const Eigen::Vector3f query = (T_ * source).cast<float>();
    if (shape == Shape::kPlane) {
      if (const auto plane = find_plane(target, query, radius_m))
        out.push_back({source, plane->centre, plane->normal});
    } else {
      if (const auto line = find_line(target, query, radius_m))
        out.push_back({source, line->centre, line->direction});
    }
  }
}

double TwoStepRegistration::residual(const Match& match, Shape shape) const noexcept {
  const Eigen::Vector3d offset = T_ * match.source - match.centre;
  return shape == Shape::kPlane ? match.axis.dot(offset) : match.axis.cross(offset).norm();
}

double TwoStepRegistration::kernel_width(const Matches& matches, Shape shape) noexcept {
  residuals_.clear();
  for (const Match& match : matches) residuals_.push_back(std::abs(residual(match, shape)));
  if (residuals_.empty()) return config_.kernel_min_m;
  double* const median = residuals_.begin() + residuals_.size() / 2;
  std::nth_element(residuals_.begin(), median, residuals_.end());
  constexpr double kMadToSigma = 1.4826;
  return std::max(config_.kernel_min_m, 3.0 * kMadToSigma * *median);
}

// With p' = R p + t and the perturbation R exp(w), t + v: a plane's n . p' changes by n . v + (p x R^T n) .
// w; a line's offset, seen across its direction, by P v - P R [p]x w.
void TwoStepRegistration::accumulate(const Matches& matches, Shape shape, NormalEquations& sum) noexcept {
  const double width = kernel_width(matches, shape);
  const Eigen::Matrix3d R = T_.linear();
  for (const Match& match : matches) {
    const Eigen::Vector3d offset = T_ * match.source - match.centre;
    if (shape == Shape::kPlane) {
      const double r = match.axis.dot(offset);
      const double weight = geman_mcclure(r, width);
      Vector6d J;
      J << match.axis, match.source.cross(R.transpose() * match.axis);
      sum.H.noalias() += weight * J * J.transpose();
      sum.b.noalias() += weight * r * J;
      sum.weight += weight, sum.weighted_sq += weight * r * r;
    } else {
      const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - match.axis * match.axis.transpose();
      const Eigen::Vector3d r = P * offset;
      const double weight = geman_mcclure(r.norm(), width);
      Eigen::Matrix<double, 3, 6> J;
      J << P, -P * R * hat(match.source);
      sum.H.noalias() += weight * J.transpose() * J;
      sum.b.noalias() += weight * J.transpose() * r;
      sum.weight += weight, sum.weighted_sq += weight * r.squaredNorm();
    }
  }
}

double TwoStepRegistration::step(const NormalEquations& sum, const std::array<int, 3>& dofs) noexcept {
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
  if (!solution.allFinite()) return 0.0;
  Vector6d delta = Vector6d::Zero();
  for (int i = 0; i < 3; ++i) delta[dofs[static_cast<std::size_t>(i)]] = solution[i];
  T_.translation() += delta.head<3>();
  T_.linear() = T_.linear() * exp_so3(delta.tail<3>());
  return solution.norm();
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
  const auto mean_sq = [&](const NormalEquations& sum) {
    return sum.weight > 0.0 ? sum.weighted_sq / sum.weight : 0.0;
  };
  result.ground_rms_m = std::sqrt(mean_sq(ground));
  result.edge_rms_m = std::sqrt(mean_sq(two));
  result.score =
      support(edges_, Shape::kLine, sources.edges.size) + support(walls_, Shape::kPlane, sources.walls.size);

  // Translation was perturbed in the target frame; the information is stated in the source frame.
  Matrix6d to_source = Matrix6d::Identity();
  to_source.topLeftCorner<3, 3>() = T_.linear();
  const double floor_sq = config_.residual_sigma_m * config_.residual_sigma_m;
  const Matrix6d H =
      ground.H / std::max(floor_sq, mean_sq(ground)) + two.H / std::max(floor_sq, mean_sq(two));
  result.information = to_source.transpose() * H * to_source;
}

}  // namespace pago::odometry
