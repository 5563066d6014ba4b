// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "tests/ground/reference/points.hpp"

namespace pago::test {

Reference rgpf_reference(const RgpfConfig& c, const Mount& mount) {
  return [c, mount](const Sweep& sweep) {
    std::map<std::pair<int, int>, PointList> bins;
    for (const Point& point : returns_of(sweep, mount)) {
      if (point.range() > c.max_range_m || point.p.z() < -c.low_cut_heights * mount.height_m) continue;
      const int ring = static_cast<int>(point.range() / (c.max_range_m / c.rings));
      const int sector = static_cast<int>(point.azimuth() / (2.0 * std::numbers::pi / c.sectors));
      bins[{std::min(ring, c.rings - 1), std::min(sector, c.sectors - 1)}].push_back(point);
    }
    Mask mask = empty_mask(sweep);
    for (const auto& [id, bin] : bins) {
      if (bin.size() <= static_cast<std::size_t>(c.min_points)) continue;
      const double lowest_m = lowest_mean(bin, c.lowest_points, -std::numeric_limits<double>::infinity());
      const Plane plane = grow(bin, bin, lowest_m + c.seed_height_m, c.ground_thickness_m, c.iterations);
      if (plane.is_valid) mark(mask, below(bin, plane, c.ground_thickness_m));
    }
    return mask;
  };
}

}  // namespace pago::test
