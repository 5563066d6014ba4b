// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "level.hpp"
#include "plane_fit.hpp"

namespace pago::ground {

/// Writes the whole mask: a return is ground where it lies in the half-space of its bin.
inline void label_by_bin(const Coordinates& returns,
                         const std::uint16_t* bin_of,
                         const HalfSpace* ground_of_bin,
                         Sweep& sweep) noexcept {
  std::uint8_t* const mask = sweep.ground.data();
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const HalfSpace& ground = ground_of_bin[bin_of[i]];
    mask[i] = ground.holds(returns.x_m[i], returns.y_m[i], returns.z_m[i]) ? kGround : kNonGround;
  }
}

}  // namespace pago::ground
