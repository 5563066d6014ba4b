// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/self_filter.hpp"

#include <algorithm>
#include <bit>

namespace pago {

namespace {

/// Whether anything is nearer, returns or what stands in the lanes without one; so it becomes vector code.
bool any_nearer(const hdl64::FiringReturns& returns, float range_sq_m2) noexcept {
  int nearer = 0;
  for (std::size_t i = 0; i < hdl64::kLasers; ++i) {
    const float x = returns.x_m[i], y = returns.y_m[i], z = returns.z_m[i];
    nearer |= x * x + y * y + z * z < range_sq_m2 ? 1 : 0;
  }
  return nearer != 0;
}

}  // namespace

SelfFilter::SelfFilter(const VehicleConfig& vehicle, const Mount& mount) {
  if (!vehicle.has_box()) return;
  const Eigen::Isometry3d T_base_sensor = mount.T_base_sensor();
  constexpr double kUnderground_m = -100.0;
  const Eigen::Vector3d min(-vehicle.rear_m, -vehicle.right_m, kUnderground_m);
  const Eigen::Vector3d max(vehicle.front_m, vehicle.left_m, vehicle.top_m);
  R_base_sensor_ = T_base_sensor.linear().cast<float>();
  min_m_ = (min - T_base_sensor.translation()).cast<float>();
  max_m_ = (max - T_base_sensor.translation()).cast<float>();
  // What lies lower than the ground is too far to matter: mirror images are the ground module's matter.
  Eigen::Vector3f corner = min_m_.cwiseAbs().cwiseMax(max_m_.cwiseAbs());
  corner.z() = std::max(std::abs(max_m_.z()), static_cast<float>(mount.height_m) + 2.0F);
  reach_sq_m2_ = corner.squaredNorm();
}

int SelfFilter::remove_own(hdl64::FiringReturns& returns) const noexcept {
  if (returns.valid == 0 || !any_nearer(returns, reach_sq_m2_)) return 0;
  std::uint64_t own = 0;
  for (std::uint64_t rest = returns.valid; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rest));
    if (is_own(returns.x_m[i], returns.y_m[i], returns.z_m[i])) own |= rest & ~(rest - 1);
  }
  returns.valid &= ~own;
  return std::popcount(own);
}

}  // namespace pago
