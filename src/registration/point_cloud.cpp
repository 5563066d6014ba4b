// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/point_cloud.hpp"

namespace pago::registration {

void deskew(const PointCloud& raw, const Vector6d& twist, PointCloud& out) noexcept {
  const Deskew to_reference(twist);
  out.size = raw.size;
  for (std::size_t i = 0; i < raw.size; ++i) {
    const Eigen::Vector3f moved = to_reference(raw.point(i), raw.before_s[i]);
    out.x_m[i] = moved.x(), out.y_m[i] = moved.y(), out.z_m[i] = moved.z();
    out.before_s[i] = 0.0F;
    out.tag[i] = raw.tag[i];
  }
}

}  // namespace pago::registration
