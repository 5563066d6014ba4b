// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "route.hpp"

namespace pago::simulator {

/// Streets on a crooked grid, a city of its own for every seed, with a way of at least `length_m` in their
/// right lanes; streets reach out of the sensor's sight on all sides of it. The same seed gives the same
/// streets whatever the length. With `loop_m` the way goes around the same blocks again and again, about so
/// far each time (440 m at least); 0: it does not.
Route make_city(std::uint64_t seed, double length_m, double loop_m = 0.0);

}  // namespace pago::simulator
