// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "pago/config/ground.hpp"
#include "pago/core/mount.hpp"
#include "pago/core/sweep.hpp"

/// Patchwork as its paper tells it, in double precision, with sorting and without any thought for speed: what
/// the optimised method is held against.
namespace pago::test {

struct ReferencePoint {
  Eigen::Vector3d p;
  std::size_t index;
};
using ReferenceBin = std::vector<ReferencePoint>;

/// Zone, ring of the zone, sector.
using ReferenceBinId = std::tuple<std::size_t, int, int>;

inline ReferenceBinId reference_bin_of(const Eigen::Vector3d& p, const PatchworkConfig& c) {
  const double near = c.min_range_m, far = c.max_range_m;
  const double bound[] = {near, (7 * near + far) / 8, (3 * near + far) / 4, (near + far) / 2, far};
  const double rho = std::hypot(p.x(), p.y());
  double theta = std::atan2(p.y(), p.x());
  if (theta < 0.0) theta += 2.0 * std::numbers::pi;
  std::size_t zone = 0;
  while (zone < 3 && rho >= bound[zone + 1]) ++zone;
  const int rings = static_cast<int>(c.zone_rings[zone]), sectors = static_cast<int>(c.zone_sectors[zone]);
  const double ring = (rho - bound[zone]) / ((bound[zone + 1] - bound[zone]) / rings);
  const double sector = theta / (2.0 * std::numbers::pi / sectors);
  return {zone, std::min(static_cast<int>(ring), rings - 1), std::min(static_cast<int>(sector), sectors - 1)};
}

struct ReferencePlane {
  bool is_valid = false;
  Eigen::Vector3d normal, mean, variance;
};

inline ReferencePlane reference_plane(const ReferenceBin& members) {
  if (members.size() < 3) return {};
  ReferencePlane plane;
  plane.mean.setZero();
  for (const ReferencePoint& m : members) plane.mean += m.p;
  plane.mean /= static_cast<double>(members.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const ReferencePoint& m : members) covariance += (m.p - plane.mean) * (m.p - plane.mean).transpose();
  covariance /= static_cast<double>(members.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  plane.variance = solver.eigenvalues();
  plane.normal = solver.eigenvectors().col(0);
  if (plane.normal.z() < 0.0) plane.normal = -plane.normal;
  plane.is_valid = true;
  return plane;
}

inline ReferenceBin below(const ReferenceBin& bin, const ReferencePlane& plane, double thickness_m) {
  ReferenceBin result;
  for (const ReferencePoint& b : bin)
    if (plane.normal.dot(b.p - plane.mean) < thickness_m) result.push_back(b);
  return result;
}

inline double reference_lowest(const ReferenceBin& sorted,
                               std::size_t zone,
                               const PatchworkConfig& c,
                               double h) {
  std::size_t first = 0;
  if (zone == 0)
    while (first < sorted.size() && sorted[first].p.z() < -c.lowest_margin * h) ++first;
  const std::size_t last = std::min(sorted.size(), first + static_cast<std::size_t>(c.lowest_points));
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += sorted[i].p.z();
  return last > first ? sum / static_cast<double>(last - first) : 0.0;
}

/// The returns of one bin that are ground.
inline ReferenceBin reference_ground(ReferenceBin bin,
                                     const ReferenceBinId& id,
                                     const PatchworkConfig& c,
                                     double h) {
  const auto [zone, zone_ring, sector] = id;
  if (bin.size() <= static_cast<std::size_t>(c.min_points)) return {};
  std::stable_sort(bin.begin(), bin.end(), [](const auto& a, const auto& b) { return a.p.z() < b.p.z(); });

  const double seed_top = reference_lowest(bin, zone, c, h) + c.seed_height_m;
  ReferenceBin members;
  for (const ReferencePoint& b : bin)
    if (b.p.z() < seed_top) members.push_back(b);
  ReferencePlane plane;
  for (int i = 0; i < c.iterations; ++i) {
    plane = reference_plane(members);
    if (!plane.is_valid) return {};
    members = below(bin, plane, c.ground_thickness_m);
  }

  if (plane.normal.z() < c.min_uprightness) return {};
  std::size_t ring = static_cast<std::size_t>(zone_ring);
  for (std::size_t inner = 0; inner < zone; ++inner) ring += static_cast<std::size_t>(c.zone_rings[inner]);
  const double elevation = plane.mean.z() + h;
  if (ring >= 4) return elevation > c.max_elevation_beyond_m ? ReferenceBin{} : members;
  const double flatness = plane.variance[0] / plane.variance.sum();
  return elevation > c.max_elevation_m[ring] && flatness >= c.max_surface_variation[ring] ? ReferenceBin{}
                                                                                          : members;
}

inline std::vector<std::uint8_t> patchwork_reference(const Sweep& sweep,
                                                     const PatchworkConfig& c,
                                                     const Mount& mount) {
  std::map<ReferenceBinId, ReferenceBin> bins;
  for (std::size_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3d raw(static_cast<double>(sweep.x_m[i]), static_cast<double>(sweep.y_m[i]),
                              static_cast<double>(sweep.z_m[i]));
    const Eigen::Vector3d p = mount.R_level_sensor() * raw;
    const double rho = std::hypot(p.x(), p.y());
    if (!p.allFinite() || !(rho > c.min_range_m && rho <= c.max_range_m)) continue;
    if (p.z() < -mount.height_m - c.low_cut_below_ground_m) continue;
    bins[reference_bin_of(p, c)].push_back({p, i});
  }
  std::vector<std::uint8_t> mask(sweep.size, kNonGround);
  for (const auto& [id, bin] : bins)
    for (const ReferencePoint& g : reference_ground(bin, id, c, mount.height_m)) mask[g.index] = kGround;
  return mask;
}

}  // namespace pago::test
