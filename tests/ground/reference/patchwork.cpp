// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>

#include "tests/ground/reference/points.hpp"

namespace pago::test {
namespace {

/// The returns of one bin that are ground.
PointList ground_in(const PointList& bin, const ZoneBin& id, const PatchworkConfig& c, double h) {
  if (bin.size() <= static_cast<std::size_t>(c.min_points)) return {};
  const double floor_m = id.zone == 0 ? -c.lowest_margin * h : -std::numeric_limits<double>::infinity();
  const double lowest_m = lowest_mean(bin, c.lowest_points, floor_m);
  const Plane plane = grow(bin, bin, lowest_m + c.seed_height_m, c.ground_thickness_m, c.iterations);
  if (!plane.is_valid || plane.normal.z() < c.min_uprightness) return {};
  PointList ground = below(bin, plane, c.ground_thickness_m);
  const double elevation = plane.mean.z() + h;
  if (id.ring >= 4) return elevation > c.max_elevation_beyond_m ? PointList{} : ground;
  const auto ring = static_cast<std::size_t>(id.ring);
  const bool is_flat = plane.variance[0] / plane.variance.sum() < c.max_surface_variation[ring];
  return elevation > c.max_elevation_m[ring] && !is_flat ? PointList{} : ground;
}

}  // namespace

Reference patchwork_reference(const PatchworkConfig& c, const Mount& mount) {
  return [c, mount](const Sweep& sweep) {
    std::map<ZoneBin, PointList> bins;
    for (const Point& point : returns_of(sweep, mount)) {
      const bool is_inside = point.range() > c.min_range_m && point.range() <= c.max_range_m;
      if (!is_inside || point.p.z() < -mount.height_m - c.low_cut_below_ground_m) continue;
      bins[zone_bin_of(point, c.min_range_m, c.max_range_m, c.zone_rings, c.zone_sectors)].push_back(point);
    }
    Mask mask = empty_mask(sweep);
    for (const auto& [id, bin] : bins) mark(mask, ground_in(bin, id, c, mount.height_m));
    return mask;
  };
}

}  // namespace pago::test
