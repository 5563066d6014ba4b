// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/map_sweep.hpp"

namespace pago::output {

void take(const Sweep& sweep, const RefinedState& refined, MapSweep& out) noexcept {
  const bool is_compensated = sweep.motion.is_compensated;
  out.sequence = sweep.header.sequence;
  out.T_odom_reference = refined.T_odom_reference;
  out.twist = is_compensated ? Vector6d::Zero() : refined.twist;
  const std::int64_t reference_ns = sweep.motion.reference_ns - sweep.header.start_ns;
  out.size = 0;
  for (const std::uint32_t i : sweep.features.dense) {
    if (out.size == out.x_m.size()) return;
    const std::uint32_t to = out.size++;
    out.x_m[to] = sweep.x_m[i], out.y_m[to] = sweep.y_m[i], out.z_m[to] = sweep.z_m[i];
    out.before_s[to] =
        is_compensated ? 0.0F : static_cast<float>(reference_ns - sweep.time_offset_ns[i]) * 1e-9F;
    out.intensity[to] = sweep.intensity[i];
    out.ground[to] = sweep.ground[i];
  }
}

}  // namespace pago::output
