// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "local_map.hpp"

#include <algorithm>

namespace pago::mapping {

registration::CellMapOptions options_of(const CellsConfig& c) noexcept {
  return {registration::CellShape::kPlane,
          c.cell_m,
          c.max_points,
          c.min_points,
          c.max_flatness,
          c.max_thickness_m,
          c.min_width_m};
}

void insert_points(const registration::PointCloud& points,
                   const MotionInSweep& motion,
                   const Eigen::Isometry3d& T_map_sensor,
                   registration::CellMap& map,
                   std::size_t stride) noexcept {
  const Deskew to_reference(motion);
  for (std::size_t i = 0; i < points.size; i += stride) {
    const Eigen::Vector3f p = to_reference(points.point(i), points.before_s[i]);
    map.insert(T_map_sensor * p.cast<double>(), points.tag[i]);
  }
}

void copy(const registration::PointCloud& from, registration::PointCloud& to) noexcept {
  to.size = std::min(from.size, to.x_m.size());
  const auto n = static_cast<std::ptrdiff_t>(to.size);
  std::copy_n(from.x_m.begin(), n, to.x_m.begin());
  std::copy_n(from.y_m.begin(), n, to.y_m.begin());
  std::copy_n(from.z_m.begin(), n, to.z_m.begin());
  std::copy_n(from.before_s.begin(), n, to.before_s.begin());
  std::copy_n(from.tag.begin(), n, to.tag.begin());
}

}  // namespace pago::mapping
