// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "level.hpp"

namespace pago::ground {

Leveller::Leveller(const Mount& mount, std::uint32_t max_returns)
    : R_level_sensor_(mount.R_level_sensor().cast<float>()), is_tilted_(!R_level_sensor_.isIdentity(1e-6F)) {
  if (!is_tilted_) return;
  x_m_ = AlignedArray<float>(max_returns);
  y_m_ = AlignedArray<float>(max_returns);
  z_m_ = AlignedArray<float>(max_returns);
}

Coordinates Leveller::operator()(const Sweep& sweep, std::uint32_t from, std::uint32_t until) noexcept {
  const float* const x = sweep.x_m.data();
  const float* const y = sweep.y_m.data();
  const float* const z = sweep.z_m.data();
  if (!is_tilted_) return {x, y, z};

  const Eigen::Matrix3f R = R_level_sensor_;
  float* const level_x = x_m_.data();
  float* const level_y = y_m_.data();
  float* const level_z = z_m_.data();
#pragma omp simd
  for (std::uint32_t i = from; i < until; ++i) {
    level_x[i] = R(0, 0) * x[i] + R(0, 1) * y[i] + R(0, 2) * z[i];
    level_y[i] = R(1, 0) * x[i] + R(1, 1) * y[i] + R(1, 2) * z[i];
    level_z[i] = R(2, 0) * x[i] + R(2, 1) * y[i] + R(2, 2) * z[i];
  }
  return {level_x, level_y, level_z};
}

}  // namespace pago::ground
