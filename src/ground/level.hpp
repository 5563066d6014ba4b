// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/core/mount.hpp"
#include "pago/core/sweep.hpp"

namespace pago::ground {

/// Coordinates of a sweep's returns about the sensor's origin, z up. Index as the sweep's own arrays.
struct Coordinates {
  const float* x_m = nullptr;
  const float* y_m = nullptr;
  const float* z_m = nullptr;
};

/// Undoes the mount's roll and pitch. For a level sensor this is the sweep's own arrays and costs nothing.
/// The origin stays in the sensor: the polar bins are centred where the returns are densest.
class Leveller {
 public:
  /// [set-up] Allocates when the mount is tilted.
  Leveller(const Mount& mount, std::uint32_t max_returns);

  /// [front thread] The sweep's coordinates, of which [from, until) are brought up to date.
  Coordinates operator()(const Sweep& sweep, std::uint32_t from, std::uint32_t until) noexcept;

 private:
  Eigen::Matrix3f R_level_sensor_;
  bool is_tilted_;
  AlignedArray<float> x_m_, y_m_, z_m_;
};

}  // namespace pago::ground
