// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "streets.hpp"
#include "way.hpp"

namespace pago::simulator {

/// Streets on a crooked grid, and a way through them.
struct City {
  std::vector<StreetPoint> streets;
  Way way;                      ///< what the vehicle's middle follows: the right lane, corners rounded
  std::vector<double> stops_m;  ///< along the way
};

/// A city of its own for every seed, with a way of at least `length_m`; streets reach out of the sensor's
/// sight on all sides of it. The same seed gives the same streets whatever the length.
City make_city(std::uint64_t seed, double length_m);

}  // namespace pago::simulator
