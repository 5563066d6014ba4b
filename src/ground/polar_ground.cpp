// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "polar_ground.hpp"

namespace pago::ground {

PolarGround::PolarGround(PolarGrid grid, const Mount& mount, std::uint32_t max_returns)
    : level_(mount, max_returns),
      bins_(std::move(grid), max_returns),
      ground_(static_cast<std::size_t>(bins_.grid().num_bins()) + 1, HalfSpace::nothing()) {}

Coordinates PolarGround::locate(const Sweep& sweep, std::uint32_t until, float min_z_m) noexcept {
  const Coordinates returns = level_(sweep, bins_.located(), until);
  bins_.locate(returns, until, min_z_m);
  return returns;
}

}  // namespace pago::ground
