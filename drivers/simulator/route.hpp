// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "streets.hpp"
#include "way.hpp"

namespace pago::simulator {

/// The streets of a world, and a way through them.
struct Route {
  std::vector<StreetPoint> streets;
  Way way;                      ///< what the vehicle's middle follows
  std::vector<double> stops_m;  ///< along the way
};

}  // namespace pago::simulator
