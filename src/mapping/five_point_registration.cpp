// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "five_point_registration.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "nearest_five.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/registration/loam_rows.hpp"

namespace pago::mapping {

namespace {

constexpr std::size_t kMinMapEdges = 10, kMinMapPlanars = 100;  // LeGO-LOAM

Matrix6d strong_directions(const Matrix6d& H, double min_eigenvalue) noexcept {
  const Eigen6 axes = eigen_of(H);
  return registration::strong_directions<6>(axes.values, axes.vectors, min_eigenvalue);
}

}  // namespace

std::optional<registration::Row> map_row(const Eigen::Isometry3d& T_map_sensor,
                                         const Eigen::Vector3d& source,
                                         const Eigen::Vector3d& normal,
                                         double distance_m,
                                         double range_factor) noexcept {
  constexpr double kSlope = 0.9;
  const double s = 1.0 - kSlope * std::abs(distance_m) / range_factor;
  return registration::loam_row(T_map_sensor, source, normal, distance_m, s);
}

void FivePointRegistration::match(const FeatureClouds& scan, const Eigen::Isometry3d& T_map_sensor) {
  rows_.clear();
  for (const Eigen::Vector3f& p : scan.edges) {
    const Eigen::Vector3d source = p.cast<double>(), point = T_map_sensor * source;
    const auto five = nearest_five(edges_, point, config_.match_radius_m);
    const auto line = five ? line_through(*five) : std::nullopt;
    if (!line) continue;
    const Eigen::Vector3d from_centre = point - line->centre;
    const Eigen::Vector3d off = from_centre - line->direction.dot(from_centre) * line->direction;
    const double distance_m = off.norm();
    if (!(distance_m > 0.0)) continue;
    if (const auto row = map_row(T_map_sensor, source, off / distance_m, distance_m, 1.0))
      rows_.push_back(*row);
  }
  for (const Eigen::Vector3f& p : scan.planars) {
    const Eigen::Vector3d source = p.cast<double>(), point = T_map_sensor * source;
    const auto five = nearest_five(planars_, point, config_.match_radius_m);
    const auto plane = five ? plane_through(*five) : std::nullopt;
    if (!plane) continue;
    const double distance_m = plane->normal.dot(point) - plane->distance_m;
    if (const auto row = map_row(T_map_sensor, source, plane->normal, distance_m, std::sqrt(point.norm())))
      rows_.push_back(*row);
  }
}

FivePointResult FivePointRegistration::align(FeatureClouds map,
                                             const FeatureClouds& scan,
                                             const Eigen::Isometry3d& T_guess) {
  FivePointResult result;
  result.T_map_sensor = T_guess;
  result.offered = static_cast<std::uint32_t>(scan.edges.size() + scan.planars.size());
  if (map.edges.size() <= kMinMapEdges || map.planars.size() <= kMinMapPlanars) return result;
  edges_.build(std::move(map.edges));
  planars_.build(std::move(map.planars));
  std::optional<Matrix6d> strong;
  for (result.iterations = 0; result.iterations < config_.max_iterations; ++result.iterations) {
    match(scan, result.T_map_sensor);
    result.matches = static_cast<std::uint32_t>(rows_.size());
    if (static_cast<int>(rows_.size()) < config_.min_matches) continue;
    registration::NormalEquations sum;
    sum.add(rows_);
    result.H = sum.H, result.rms_m = sum.rms_m();
    if (!strong) strong = strong_directions(sum.H, config_.min_eigenvalue);
    const Vector6d step = *strong * solve_semidefinite(sum.H, -sum.b) * config_.update_gain;
    if (!step.allFinite()) break;
    result.T_map_sensor = perturb(result.T_map_sensor, step);
    result.is_registered = true;
    if (step.head<3>().norm() < config_.stop_translation_m &&
        step.tail<3>().norm() < config_.stop_rotation_rad)
      break;
  }
  result.T_map_sensor = orthonormalized(result.T_map_sensor);
  return result;
}

}  // namespace pago::mapping
