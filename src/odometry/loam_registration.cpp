// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/loam_registration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "pago/core/se3.hpp"
#include "pago/registration/loam_rows.hpp"
#include "pago/registration/voxel_means.hpp"

namespace pago::odometry {

namespace {

// Degrees of freedom in the order x y z roll pitch yaw.
constexpr std::array<int, 3> kPlanarSteps{2, 3, 4};
constexpr std::array<int, 3> kEdgeSteps{0, 1, 5};

constexpr std::size_t kMinRows = 10, kMinEdges = 10, kMinPlanars = 100;  // LeGO-LOAM
constexpr std::size_t kMostSources = kNumRings * 6 * 20;

/// Of each row's features those that `takes`, thinned to means of voxels.
template <typename Takes>
RowCloud rows_of(const Sweep& sweep,
                 const FixedVector<std::uint32_t>& list,
                 const std::array<std::uint32_t, kNumRings + 1>& rows,
                 const Vector6d& twist,
                 double voxel_m,
                 Takes takes) {
  const Deskew to_reference(twist);
  RowCloud cloud;
  std::vector<Eigen::Vector3f> row_points;
  for (std::size_t row = 0; row < kNumRings; ++row) {
    row_points.clear();
    for (std::uint32_t n = rows[row]; n < rows[row + 1]; ++n) {
      const std::uint32_t i = list[n];
      if (!takes(i)) continue;
      row_points.push_back(
          to_reference({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, sweep.before_reference_s(i)));
    }
    registration::voxel_means(row_points, voxel_m, cloud.points);
    cloud.begin[row + 1] = static_cast<std::uint32_t>(cloud.points.size());
  }
  return cloud;
}

Eigen::Matrix3d strong_directions(const Eigen::Matrix3d& H, double min_eigenvalue) noexcept {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(H);
  return registration::strong_directions<3>(axes.eigenvalues(), axes.eigenvectors(), min_eigenvalue);
}

}  // namespace

LoamRegistration::LoamRegistration(const OdometryConfig& config)
    : config_(config),
      edges_(config.match_radius_m),
      ground_(config.match_radius_m),
      others_(config.match_radius_m),
      deskewed_(kMostSources) {}

void LoamRegistration::set_targets(const Sweep& sweep, const Vector6d& twist) noexcept {
  const FeatureLists& lists = sweep.features;
  const auto is_ground = [&](std::uint32_t i) { return sweep.ground[i] == kGround; };
  const auto planars = [&](auto takes) {
    return rows_of(sweep, lists.planars, lists.planar_rows, twist, config_.loam.target_voxel_m, takes);
  };
  edges_.build(rows_of(sweep, lists.edges, lists.edge_rows, twist, 0.0, [](std::uint32_t) { return true; }));
  if (config_.loam.same_surface) {
    ground_.build(planars(is_ground));
    others_.build(planars([&](std::uint32_t i) { return !is_ground(i); }));
  } else {
    ground_.build(planars([](std::uint32_t) { return true; }));
  }
}

bool LoamRegistration::has_targets() const noexcept {
  return edges_.cloud().points.size() >= kMinEdges &&
         ground_.cloud().points.size() + others_.cloud().points.size() >= kMinPlanars;
}

RegistrationResult LoamRegistration::align(const FeatureSet& sources,
                                           const Eigen::Isometry3d& T_guess,
                                           double period_s) noexcept {
  T_ = T_guess;
  RegistrationResult result;
  result.T_target_source = T_guess;
  planes_.clear(), lines_.clear();
  if (!has_targets()) return result;
  const auto at_reference = [&](const PointCloud& cloud) -> const PointCloud& {
    Vector6d twist = Vector6d::Zero();
    if (period_s > 0.0 && config_.deskew) twist = log_se3(T_) / period_s;
    registration::deskew(cloud, twist, deskewed_);
    return deskewed_;
  };
  const LoamTargets& walls = config_.loam.same_surface ? others_ : ground_;
  const int one = run_step(
      kPlanarSteps,
      [&] {
        planes_.clear();
        match_planes(at_reference(sources.ground), ground_);
        match_planes(at_reference(sources.walls), walls);
      },
      [&](bool is_weighted) { add_plane_rows(is_weighted); });
  const int two = run_step(
      kEdgeSteps, [&] { match_lines(at_reference(sources.edges)); },
      [&](bool is_weighted) { add_line_rows(is_weighted); });

  result.T_target_source = T_ = orthonormalized(T_);
  result.rounds = one + two;
  result.ground_matches = static_cast<std::uint32_t>(planes_.size());
  result.edge_matches = static_cast<std::uint32_t>(lines_.size());
  registration::NormalEquations planes, lines;
  rows_.clear(), add_plane_rows(true), planes.add(rows_);
  rows_.clear(), add_line_rows(true), lines.add(rows_);
  result.ground_rms_m = planes.rms_m(), result.edge_rms_m = lines.rms_m();
  result.information = planes.H / (config_.point_sigma_m * config_.point_sigma_m) +
                       lines.H / (config_.edge_sigma_m * config_.edge_sigma_m);
  return result;
}

void LoamRegistration::match_planes(const PointCloud& cloud, const LoamTargets& targets) noexcept {
  const auto& points = targets.cloud().points;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d source = cloud.point(i).cast<double>();
    const auto found = targets.find_plane((T_ * source).cast<float>());
    if (!found) continue;
    const auto& [a, b, c] = *found;
    planes_.push_back({source, points[a].cast<double>(), points[b].cast<double>(), points[c].cast<double>()});
  }
}

void LoamRegistration::match_lines(const PointCloud& cloud) noexcept {
  lines_.clear();
  const auto& points = edges_.cloud().points;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3d source = cloud.point(i).cast<double>();
    const auto found = edges_.find_line((T_ * source).cast<float>());
    if (!found) continue;
    const auto& [a, b] = *found;
    lines_.push_back({source, points[a].cast<double>(), points[b].cast<double>()});
  }
}

/// Returns how many iterations there were.
template <typename Associate, typename AddRows>
int LoamRegistration::run_step(const std::array<int, 3>& dofs,
                               Associate associate,
                               AddRows add_rows) noexcept {
  const int most = config_.max_rounds * config_.steps_per_round;
  std::optional<Eigen::Matrix3d> strong;
  for (int iteration = 0; iteration < most; ++iteration) {
    if (iteration % config_.steps_per_round == 0) associate();
    rows_.clear();
    add_rows(iteration >= config_.steps_per_round);
    if (rows_.size() < kMinRows) continue;
    registration::NormalEquations sum;
    sum.add(rows_);
    Eigen::Matrix3d H;
    Eigen::Vector3d b;
    for (int i = 0; i < 3; ++i) {
      b[i] = sum.b[dofs[static_cast<std::size_t>(i)]];
      for (int j = 0; j < 3; ++j)
        H(i, j) = sum.H(dofs[static_cast<std::size_t>(i)], dofs[static_cast<std::size_t>(j)]);
    }
    if (!strong) strong = strong_directions(H, config_.loam.min_eigenvalue);
    const Eigen::Vector3d step = *strong * (H.ldlt().solve(-b) * config_.update_gain);
    if (!step.allFinite()) return iteration;
    Vector6d delta = Vector6d::Zero();
    for (int i = 0; i < 3; ++i) delta[dofs[static_cast<std::size_t>(i)]] = step[i];
    T_ = perturb(T_, delta);
    if (delta.head<3>().norm() < config_.stop_translation_m &&
        delta.tail<3>().norm() < config_.stop_rotation_rad)
      return iteration + 1;
  }
  return most;
}

void LoamRegistration::add_row(const Eigen::Vector3d& source,
                               const Offset& offset,
                               double range_factor,
                               bool is_weighted) noexcept {
  constexpr double kSlope = 1.8;
  if (offset.distance_m == 0.0) return;
  const double s = is_weighted ? 1.0 - kSlope * std::abs(offset.distance_m) / range_factor : 1.0;
  if (const auto row = registration::loam_row(T_, source, offset.normal, offset.distance_m, s))
    rows_.push_back(*row);
}

void LoamRegistration::add_plane_rows(bool is_weighted) noexcept {
  for (const PlaneMatch& match : planes_) {
    const Eigen::Vector3d point = T_ * match.source;
    if (const auto offset = offset_from_plane(point, match.a, match.b, match.c))
      add_row(match.source, *offset, std::sqrt(point.norm()), is_weighted);
  }
}

void LoamRegistration::add_line_rows(bool is_weighted) noexcept {
  for (const LineMatch& match : lines_) {
    if (const auto offset = offset_from_line(T_ * match.source, match.a, match.b))
      add_row(match.source, *offset, 1.0, is_weighted);
  }
}

}  // namespace pago::odometry
