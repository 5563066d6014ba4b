// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [assembly]
///
/// A sweep takes 29 bytes per return and 1.2 MB for its range image. The default holds whatever 4,352 firings
/// of 64 lasers return, a rotation at 4.8 Hz: 9.3 MB a sweep, 56 MB for the ring of six. Dual return at 5 Hz
/// needs 460,800: 14.6 MB a sweep, 88 MB.
struct AssemblyConfig {
  double cut_azimuth_deg = 180.0;
  int ring_size = 6;
  int max_returns = 4352 * 64;
  int sectors = 1;
  int reorder_window = 4;
};

template <typename Visitor>
void describe(Visitor& v, AssemblyConfig& c) {
  v("cut_azimuth_deg", c.cut_azimuth_deg, within(0.0, 360.0),
    "encoder azimuth at which a sweep ends and the next begins; 180 is behind the vehicle");
  v("ring_size", c.ring_size, within(2, 64), "sweeps that exist; more than can be in flight at once");
  v("max_returns", c.max_returns, within(64.0 * 1000, 460'800),
    "returns that a sweep can hold; a fuller one is closed early");
  v("sectors", c.sectors, within(1, 72),
    "parts in which a sweep is handed on while it is filled; 1 = whole sweeps");
  v("reorder_window", c.reorder_window, within(0, 64),
    "packets that are held back at most while a missing one may still come");
}

}  // namespace pago
