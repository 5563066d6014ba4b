// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// Where a simulated drive takes place.
enum class SimulatedWorld : std::uint8_t {
  kUrban  ///< city blocks: kerbs, house fronts with recesses, parked cars, street trees
};

/// [simulator] A drive through a made-up world, and the HDL-64E that sees it. Settings of other sections that
/// it obeys as well: hdl64.calibration (the unit; empty: a made-up one of S2.1's kind),
/// hdl64.vertical_offset, hdl64.packet_stamp, and mount.
struct SimulatorConfig {
  SimulatedWorld world = SimulatedWorld::kUrban;
  int seed = 1;
  double seconds = 20.0;

  std::string path;
  int path_first = 0;
  double speed = 1.0;
  double start_speed_m_s = 0.0;

  double rotation_hz = 10.0;
  double range_noise_m = 0.015;
  double range_bias_m = 0.008;
  double angle_error_deg = 0.02;
  double outliers = 0.0;
  double wetness = 0.0;
  double traffic = 1.0;
};

template <typename Visitor>
void describe(Visitor& v, SimulatorConfig& c) {
  v("world", c.world, choices(std::pair{"urban", SimulatedWorld::kUrban}), "where the drive takes place");
  v("seed", c.seed, within(0, 1'000'000'000), "another seed is another world, drive and noise");
  v("seconds", c.seconds, within(0.1, 36'000.0),
    "length of the drive; a path that is shorter ends it earlier");
  v("path", c.path,
    "poses to drive along, of a camera as in KITTI's pose files (12 numbers a line, 0.1 s apart); empty: a "
    "drive is made up");
  v("path_first", c.path_first, within(0, 10'000'000), "the first of these poses that is used");
  v("speed", c.speed, within(0.1, 4.0), "drives the same way this much faster");
  v("start_speed_m_s", c.start_speed_m_s, within(0.0, 40.0), "of a made-up drive; before `speed` is applied");
  v("rotation_hz", c.rotation_hz, within(5.0, 20.0), "of the sensor's head");
  v("range_noise_m", c.range_noise_m, within(0.0, 0.2),
    "standard deviation of a distance, square on; grows at grazing incidence (S2 data sheet: 0.015)");
  v("range_bias_m", c.range_bias_m, within(0.0, 0.1),
    "standard deviation between lasers of a distance offset that the calibration file does not know");
  v("angle_error_deg", c.angle_error_deg, within(0.0, 0.5),
    "the same for each laser's vertical and horizontal angle");
  v("outliers", c.outliers, within(0.0, 0.2), "part of the beams that rain drops send back");
  v("wetness", c.wetness, within(0.0, 1.0),
    "of the road: 0 dry, 1 as after rain, when half of its returns are lost");
  v("traffic", c.traffic, within(0.0, 4.0),
    "moving cars and pedestrians, against what the world usually has");
}

}  // namespace pago
