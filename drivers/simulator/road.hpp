// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "route.hpp"

namespace pago::simulator {

/// A noise that bends or lifts: amplitude, and over what distance it changes.
struct Waves {
  double amplitude = 0.0;  ///< radians of heading or metres of height
  double size_m = 100.0;
};

/// A road through the country.
struct RoadShape {
  double half_width_m = 3.1;  ///< of each carriageway
  double lane_m = 1.5;        ///< from the carriageway's middle to the right: where the vehicle drives
  double median_m = 0.0;      ///< strip between two carriageways, one for each direction; 0: one for both
  Waves sweep{0.9, 190.0}, bend{0.5, 60.0};     ///< of the heading
  Waves hills{9.0, 260.0}, ripples{1.5, 70.0};  ///< of the height
  double stops_per_km = 0.0;
  double least_loop_m = 600.0;  ///< a shorter loop would cross itself
};

/// Where a carriageway's middle is, seen from the middle of the whole road, to the right.
inline double carriageway_right_m(const RoadShape& shape) {
  return shape.median_m > 0.0 ? 0.5 * shape.median_m + shape.half_width_m : 0.0;
}

/// A road of its own for every seed. With `loop_m` it closes after about so many metres, and the way goes
/// around it again and again; with 0 it goes on, to beyond the sensor's sight at both ends of the way. A loop
/// shorter than the shape's least is an Error.
Route make_road(const RoadShape& shape, std::uint64_t seed, double length_m, double loop_m);

}  // namespace pago::simulator
