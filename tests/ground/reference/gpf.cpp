// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <map>

#include "tests/ground/reference/points.hpp"

namespace pago::test {

Reference gpf_reference(const GpfConfig& c, const Mount& mount, LowReturns low) {
  return [c, mount, low](const Sweep& sweep) {
    std::map<int, PointList> slabs;
    for (const Point& point : returns_of(sweep, mount)) {
      const double ahead_m = std::cos(mount.yaw_rad) * point.p.x() - std::sin(mount.yaw_rad) * point.p.y();
      const int slab = ahead_m > c.slab_m ? 1 : ahead_m < -c.slab_m ? -1 : 0;
      slabs[c.planes == GpfConfig::Planes::kSlabs ? slab : 0].push_back(point);
    }
    Mask mask = empty_mask(sweep);
    for (const auto& [id, slab] : slabs) {
      PointList starters;
      for (const Point& point : slab)
        if (point.p.z() >= -c.low_cut_heights * mount.height_m) starters.push_back(point);
      const PointList& tested = low == LowReturns::kTested ? slab : starters;
      const double lowest_m =
          lowest_mean(starters, c.lowest_points, -std::numeric_limits<double>::infinity());
      const Plane plane =
          grow(starters, tested, lowest_m + c.seed_height_m, c.ground_thickness_m, c.iterations);
      if (plane.is_valid) mark(mask, below(tested, plane, c.ground_thickness_m));
    }
    return mask;
  };
}

}  // namespace pago::test
