// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/core/aligned_array.hpp"
#include "pago/core/sweep.hpp"

namespace pago::output {

/// What a keyframe leaves to the saved map: its whole sweep, thinned evenly (FeatureLists::dense), as the
/// sensor saw it, and what is needed to move it to one instant and into `odom`. Structure of arrays. [set-up]
/// constructor.
struct MapSweep {
  explicit MapSweep(std::uint32_t max_points)
      : x_m(max_points),
        y_m(max_points),
        z_m(max_points),
        before_s(max_points),
        intensity(max_points),
        ground(max_points) {}

  std::uint64_t sequence = 0;
  Eigen::Isometry3d T_odom_reference = Eigen::Isometry3d::Identity();  ///< at the sweep's reference instant
  Vector6d twist = Vector6d::Zero();  ///< per second, sensor frame; zero for compensated sweeps
  std::uint32_t size = 0;
  AlignedArray<float> x_m, y_m, z_m;
  AlignedArray<float> before_s;  ///< firing time before the reference instant
  AlignedArray<std::uint8_t> intensity, ground;
};

/// [estimate thread] Real-time safe; what is beyond the room in `out` is left out.
void take(const Sweep& sweep, const RefinedState& refined, MapSweep& out) noexcept;

}  // namespace pago::output
