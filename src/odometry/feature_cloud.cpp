// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/feature_cloud.hpp"

namespace pago::odometry {

// exp(a) p = p + a x p + a x (a x p) / 2 + ..., and its translation V(a) u = u + a x u / 2 + a x (a x u) / 6
// + ...
void deskew(const FeatureCloud& raw, const Vector6d& twist, FeatureCloud& out) noexcept {
  const Eigen::Vector3f v = twist.head<3>().cast<float>(), w = twist.tail<3>().cast<float>();
  const Eigen::Vector3f wv = w.cross(v), wwv = w.cross(wv);
  out.size = raw.size;
  for (std::size_t i = 0; i < raw.size; ++i) {
    const float s = -raw.before_s[i];
    const Eigen::Vector3f p = raw.point(i);
    const Eigen::Vector3f wp = w.cross(p), wwp = w.cross(wp), wwwp = w.cross(wwp);
    const Eigen::Vector3f moved =
        p + s * (wp + v + s * (0.5F * (wwp + wv) + s * (1.0F / 6.0F) * (wwwp + wwv)));
    out.x_m[i] = moved.x(), out.y_m[i] = moved.y(), out.z_m[i] = moved.z();
    out.before_s[i] = 0.0F;
    out.ring[i] = raw.ring[i];
  }
}

}  // namespace pago::odometry
