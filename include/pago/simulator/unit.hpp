// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/hdl64/calibration.hpp"

namespace pago::simulator {

/// The calibration of a unit that does not exist, as an S2.1's looks: two-point, upper lasers 1/3 degree
/// apart from +2 degrees down, lower ones 1/2 degree apart down to -24.8, azimuths fanned out to +-6 degrees,
/// offsets of 12 to 21 cm (vertical) and +-2.6 cm (horizontal), distances corrected by 1.2 to 1.5 m. All
/// figures are whole hundredths of a degree and millimetres, as the unit itself can send them. [any thread]
/// always the same.
hdl64::Calibration made_up_unit();

/// How a real unit differs from its own calibration file: standard deviations between lasers.
struct UnitErrors {
  double range_m = 0.0;
  double angle_rad = 0.0;  ///< of the vertical and of the horizontal angle, each
};
hdl64::Calibration imperfect(const hdl64::Calibration& file, const UnitErrors& errors, std::uint64_t seed);

/// The text of Velodyne's db.xml for a unit. hdl64::load_calibration reads the same figures from it.
std::string calibration_xml(const hdl64::Calibration& unit);

}  // namespace pago::simulator
