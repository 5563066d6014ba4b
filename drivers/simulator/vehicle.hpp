// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "ground.hpp"
#include "way.hpp"

namespace pago::simulator {

/// How fast a way is driven. Metres and seconds.
struct Pace {
  double cruise_m_s = 11.0;
  double start_m_s = 0.0;
  double lateral_m_s2 = 2.2;  ///< in bends
  double accelerate_m_s2 = 1.5, brake_m_s2 = 2.2;
  double stop_s = 2.5;  ///< how long a stop lasts
};

/// The distances at which a vehicle is after 0, interval, 2 interval, ... until `seconds` or the way's end.
std::vector<double> distances_driven(
    const Way& way, std::span<const double> stops_m, const Pace& pace, double interval_s, double seconds);

/// T_world_base of a car with springs that drives over the ground so. base_link is on the ground, below the
/// middle between its axles. The driver steers as people do, up to 15 cm off the way, and
/// corrects about every `corrects_every_m`; 0: keeps to the way.
std::vector<Eigen::Isometry3d> drive_over(const Ground& ground,
                                          const Way& way,
                                          std::span<const double> distances_m,
                                          double interval_s,
                                          double corrects_every_m,
                                          std::uint64_t seed);

}  // namespace pago::simulator
