// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ransac_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "random.hpp"

namespace pago::ground {
namespace {

Eigen::Vector3d point(const Points& points, std::uint64_t i) noexcept {
  return Eigen::Vector3f(points.x_m[i], points.y_m[i], points.z_m[i]).cast<double>();
}

/// Through three random points, normal up; nothing if they are (nearly) on a line.
std::optional<Slab> random_slab(const Points& points, double half_thickness_m, Random& random) noexcept {
  const std::uint64_t n = points.size();
  const Eigen::Vector3d a = point(points, random.below(n)), b = point(points, random.below(n)),
                        c = point(points, random.below(n));
  const Eigen::Vector3d across = (b - a).cross(c - a);
  const double area = across.norm();
  constexpr double kNoArea_m2 = 1e-6;
  if (!(area > kNoArea_m2)) return std::nullopt;
  const Eigen::Vector3d normal = across.z() < 0.0 ? Eigen::Vector3d(across / -area) : across / area;
  return Slab::around(normal, normal.dot(a), half_thickness_m);
}

/// How many points the slab holds, if more than `to_beat`; else something not more than that.
std::size_t count_if_more(const Points& points, const Slab& slab, std::size_t to_beat) noexcept {
  constexpr std::size_t kChunk = 1024;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunk) {
    if (count + (points.size() - begin) <= to_beat) return count;
    count += count_inside(points.from(begin, std::min(kChunk, points.size() - begin)), slab);
  }
  return count;
}

/// How many samples hold a sample of inliers alone with this confidence.
double samples_needed(double inlier_share, double confidence) noexcept {
  const double all_inliers = inlier_share * inlier_share * inlier_share;
  return std::log(1.0 - confidence) / std::log1p(-all_inliers);
}

}  // namespace

PlaneFit ransac_plane(const Points& points, const RansacRule& rule, std::uint64_t seed) noexcept {
  if (points.size() < 3) return {};
  Random random(seed);
  std::size_t most = 0;
  Slab best;
  double needed = rule.max_iterations;
  for (int tried = 0; tried < rule.max_iterations && tried < needed; ++tried) {
    const std::optional<Slab> slab = random_slab(points, rule.inlier_distance_m, random);
    if (!slab || static_cast<double>(slab->normal_z) < rule.min_uprightness) continue;
    const std::size_t count = count_if_more(points, *slab, most);
    if (count <= most) continue;
    most = count;
    best = *slab;
    needed = samples_needed(static_cast<double>(most) / static_cast<double>(points.size()), rule.confidence);
  }
  if (most < 3) return {};
  const Eigen::Vector3f on_plane =
      0.5F * (best.lower_m + best.upper_m) * Eigen::Vector3f(best.normal_x, best.normal_y, best.normal_z);
  return fit_plane(statistics_inside(points, best, on_plane));
}

}  // namespace pago::ground
