// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/loam_matching.hpp"

#include <algorithm>

namespace pago::odometry {

namespace {

constexpr std::uint32_t kRowReach = 2;  // LOAM: 2.5

}  // namespace

void LoamTargets::build(RowCloud cloud) {
  cloud_ = std::move(cloud);
  tree_.build(cloud_.points);
}

std::uint32_t LoamTargets::find_nearest(const Eigen::Vector3f& query) const {
  std::array<std::uint32_t, 1> index{};
  std::array<float, 1> distance_sq{};
  if (tree_.nearest(query, index, distance_sq) == 0 || !(distance_sq[0] < radius_sq_m2_)) return kNone;
  return index[0];
}

std::uint32_t LoamTargets::row_of(std::uint32_t i) const noexcept {
  const auto after = std::upper_bound(cloud_.begin.begin(), cloud_.begin.end(), i);
  return static_cast<std::uint32_t>(after - cloud_.begin.begin()) - 1;
}

void LoamTargets::consider(std::uint32_t from,
                           std::uint32_t until,
                           std::uint32_t except,
                           const Eigen::Vector3f& query,
                           float& least_sq_m2,
                           std::uint32_t& best) const noexcept {
  for (std::uint32_t i = from; i < until; ++i) {
    if (i == except) continue;
    const float distance_sq = (cloud_.points[i] - query).squaredNorm();
    if (distance_sq < least_sq_m2) least_sq_m2 = distance_sq, best = i;
  }
}

std::uint32_t LoamTargets::nearest_on_other_rows(std::uint32_t row,
                                                 const Eigen::Vector3f& query) const noexcept {
  const std::uint32_t first = row > kRowReach ? row - kRowReach : 0;
  const std::uint32_t last = std::min<std::uint32_t>(row + kRowReach, kNumRings - 1);
  float least = radius_sq_m2_;
  std::uint32_t best = kNone;
  consider(cloud_.begin[row + 1], cloud_.begin[last + 1], kNone, query, least, best);
  consider(cloud_.begin[first], cloud_.begin[row], kNone, query, least, best);
  return best;
}

std::optional<std::array<std::uint32_t, 2>> LoamTargets::find_line(const Eigen::Vector3f& query) const {
  const std::uint32_t nearest = find_nearest(query);
  if (nearest == kNone) return std::nullopt;
  const std::uint32_t other = nearest_on_other_rows(row_of(nearest), query);
  if (other == kNone) return std::nullopt;
  return std::array{nearest, other};
}

std::optional<std::array<std::uint32_t, 3>> LoamTargets::find_plane(const Eigen::Vector3f& query) const {
  const std::uint32_t nearest = find_nearest(query);
  if (nearest == kNone) return std::nullopt;
  const std::uint32_t row = row_of(nearest);
  float least = radius_sq_m2_;
  std::uint32_t beside = kNone;
  consider(cloud_.begin[row], cloud_.begin[row + 1], nearest, query, least, beside);
  const std::uint32_t other = nearest_on_other_rows(row, query);
  if (beside == kNone || other == kNone) return std::nullopt;
  return std::array{nearest, beside, other};
}

std::optional<Offset> offset_from_line(const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b) noexcept {
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d off = (point - a) - along.dot(point - a) * along;
  const double distance_m = off.norm();
  if (!(along.squaredNorm() > 0.5) || !(distance_m > 0.0)) return std::nullopt;
  return Offset{off / distance_m, distance_m};
}

std::optional<Offset> offset_from_plane(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c) noexcept {
  const Eigen::Vector3d across = (b - a).cross(c - a);
  const double size = across.norm();
  if (!(size > 0.0)) return std::nullopt;
  return Offset{across / size, across.dot(point - a) / size};
}

}  // namespace pago::odometry
