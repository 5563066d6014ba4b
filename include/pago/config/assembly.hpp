// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/config/describe.hpp"

namespace pago {

/// [assembly]
///
/// A sweep takes 30 bytes per return and 1.3 MB for its range image: with 460,800 returns 15 MB, 91 MB for
/// the ring of six.
struct AssemblyConfig {
  double cut_azimuth_deg = 180.0;
  int ring_size = 6;
  int max_returns = 0;
  int sectors = 1;
  int reorder_window = 4;
};

/// Returns that a sweep must hold: as set, or what any rotation from 5 Hz on can give.
inline std::uint32_t max_returns_of(const AssemblyConfig& config, bool can_be_dual) noexcept {
  constexpr std::uint32_t kSingle = 4736 * 64, kDual = 460'800;  // all columns of 64 lasers; 1,200 packets
  if (config.max_returns != 0) return static_cast<std::uint32_t>(config.max_returns);
  return can_be_dual ? kDual : kSingle;
}

template <typename Visitor>
void describe(Visitor& v, AssemblyConfig& c) {
  v("cut_azimuth_deg", c.cut_azimuth_deg, within(0.0, 360.0),
    "encoder azimuth at which a sweep ends and the next begins; 180 is behind the vehicle");
  v("ring_size", c.ring_size, within(2, 64), "sweeps that exist; more than can be in flight at once");
  v("max_returns", c.max_returns, within(0, 460'800),
    "returns that a sweep can hold, at least 64,000; a fuller one is closed early. 0: as many as the slowest "
    "rotation gives, 303,104, in dual-return mode 460,800");
  v("sectors", c.sectors, within(1, 72),
    "parts in which a sweep is handed on while it is filled; 1 = whole sweeps");
  v("reorder_window", c.reorder_window, within(0, 64),
    "packets that are held back at most while a missing one may still come");
}

}  // namespace pago
