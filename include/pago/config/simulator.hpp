// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// Where a simulated drive takes place.
enum class SimulatedWorld : std::uint8_t {
  kUrban,    ///< city blocks: kerbs, house fronts with recesses, parked cars, street trees
  kRural,    ///< a winding road over hills: ditches, banks, tall grass, hedges, woods
  kHighway,  ///< two carriageways with guard rails, little beside them; starts at 25 m/s
  kTunnel,   ///< smooth walls that say little about the motion along them
  kField     ///< flat open ground
};

/// How the unit sends what it sees.
enum class SimulatedUnit : std::uint8_t {
  kS2,      ///< S2, S2.1: a firing every 48 us
  kS3,      ///< S3 in single-return mode: every 57.6 us
  kS3Dual,  ///< S3 in dual-return mode: the same, each firing with its two returns
};

/// [simulator.faults] What goes wrong on the way from the sensor to the host, or with the sensor itself.
struct SimulatorFaults {
  double lost = 0.0;
  double bursts_per_min = 0.0;
  double duplicated = 0.0;
  double reordered = 0.0;
  double corrupted = 0.0;
  double truncated = 0.0;
  double azimuth_glitches = 0.0;
  double pause_at_s = 0.0;
  double hour_ends_at_s = 0.0;
  double head_stops_at_s = 0.0;
  double power_cycle_at_s = 0.0;
};

template <typename Visitor>
void describe(Visitor& v, SimulatorFaults& c) {
  v("lost", c.lost, within(0.0, 1.0), "part of the packets that never arrive");
  v("bursts_per_min", c.bursts_per_min, within(0.0, 600.0), "losses of 10 to 100 packets in a row");
  v("duplicated", c.duplicated, within(0.0, 1.0), "part of the packets that arrive twice");
  v("reordered", c.reordered, within(0.0, 1.0), "part that arrives one to three packets late");
  v("corrupted", c.corrupted, within(0.0, 1.0), "part with one to three wrong bytes");
  v("truncated", c.truncated, within(0.0, 1.0), "part that ends too early");
  v("azimuth_glitches", c.azimuth_glitches, within(0.0, 1.0), "part with one azimuth that is anywhere");
  v("pause_at_s", c.pause_at_s, within(0.0, 36'000.0), "nothing arrives for 1.5 s from then on; 0: never");
  v("hour_ends_at_s", c.hour_ends_at_s, within(0.0, 3599.0),
    "the sensor's stamps, microseconds of the hour, begin anew then; 0: in 45 minutes");
  v("head_stops_at_s", c.head_stops_at_s, within(0.0, 36'000.0),
    "the head stands still for 2 s from then on, while lasers fire; 0: never");
  v("power_cycle_at_s", c.power_cycle_at_s, within(0.0, 36'000.0),
    "the sensor is off for 4 s from then on, and its stamps begin at 0; 0: never");
}

/// [simulator] A drive through a made-up world, and the HDL-64E that sees it. Settings of other sections that
/// it obeys as well: hdl64.calibration (the unit; empty: a made-up one of S2.1's kind),
/// hdl64.vertical_offset, hdl64.packet_stamp, and mount.
struct SimulatorConfig {
  SimulatedWorld world = SimulatedWorld::kUrban;
  int seed = 1;
  double seconds = 20.0;

  std::string path;
  int path_first = 0;
  double loop_m = 0.0;
  double speed = 1.0;
  double start_speed_m_s = 0.0;

  SimulatedUnit unit = SimulatedUnit::kS2;
  double rotation_hz = 10.0;
  double range_noise_m = 0.0075;
  double range_bias_m = 0.008;
  double angle_error_deg = 0.02;
  double outliers = 0.0;
  double wetness = 0.0;
  double traffic = 1.0;
  SimulatorFaults faults;
};

template <typename Visitor>
void describe(Visitor& v, SimulatorConfig& c) {
  v("world", c.world,
    choices(std::pair{"urban", SimulatedWorld::kUrban}, std::pair{"rural", SimulatedWorld::kRural},
            std::pair{"highway", SimulatedWorld::kHighway}, std::pair{"tunnel", SimulatedWorld::kTunnel},
            std::pair{"field", SimulatedWorld::kField}),
    "where the drive takes place");
  v("seed", c.seed, within(0, 1'000'000'000), "another seed is another world, drive and noise");
  v("seconds", c.seconds, within(0.1, 36'000.0),
    "length of the drive; a path that is shorter ends it earlier");
  v("path", c.path,
    "poses to drive along, of a camera as in KITTI's pose files (12 numbers a line, 0.1 s apart); empty: a "
    "drive is made up");
  v("path_first", c.path_first, within(0, 10'000'000), "the first of these poses that is used");
  v("loop_m", c.loop_m, within(0.0, 100'000.0),
    "a made-up drive comes back to its start after about so far, and goes around again; 0: it does not");
  v("speed", c.speed, within(0.1, 4.0), "drives the same way this much faster");
  v("start_speed_m_s", c.start_speed_m_s, within(0.0, 40.0),
    "of a made-up drive, before `speed` is applied; highway and tunnel start at 25 and 14 m/s at least");
  v("unit", c.unit,
    choices(std::pair{"s2", SimulatedUnit::kS2}, std::pair{"s3", SimulatedUnit::kS3},
            std::pair{"s3_dual", SimulatedUnit::kS3Dual}),
    "what kind of HDL-64E it is, and what it sends");
  v("rotation_hz", c.rotation_hz, within(5.0, 20.0), "of the sensor's head");
  v("range_noise_m", c.range_noise_m, within(0.0, 0.2),
    "standard deviation of a distance, square on; grows at grazing incidence (KITTI's unit: 0.0075)");
  v("range_bias_m", c.range_bias_m, within(0.0, 0.1),
    "standard deviation between lasers of a distance offset that the calibration file does not know");
  v("angle_error_deg", c.angle_error_deg, within(0.0, 0.5),
    "the same for each laser's vertical and horizontal angle");
  v("outliers", c.outliers, within(0.0, 0.2), "part of the beams that rain drops send back");
  v("wetness", c.wetness, within(0.0, 1.0),
    "of asphalt: 0 dry, 1 so wet that half of its returns are lost at 11 m (dry: 50 m), and nearly all from "
    "25 m on");
  v("traffic", c.traffic, within(0.0, 4.0),
    "moving cars and pedestrians, against what the world usually has");
  v.section("faults", c.faults, "what goes wrong with packets and sensor");
}

}  // namespace pago
