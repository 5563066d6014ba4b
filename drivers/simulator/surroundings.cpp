// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "city.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "presets.hpp"
#include "recorded_path.hpp"

namespace pago::simulator {
namespace {

constexpr double kInterval_s = 0.02;  // between the poses of a drive
constexpr double kAfter_s = 4.0;      // what drives ahead needs to know of the time after the drive
constexpr double kVehicleHalf_m = 0.9;
/// Between a driver's corrections. With it the change of yaw from sweep to sweep is that of KITTI's 01 on a
/// highway.
constexpr double kCorrection_s = 2.3;

/// Where a vehicle is on its way, every kInterval_s.
struct Drive {
  Route route;
  std::vector<double> distances_m;
  std::size_t last = 0;           ///< of the distances; what comes after is for others on the road
  double corrects_every_m = 0.0;  ///< its driver; a recorded path has its own
};

/// A little more than is asked for, since the last rotation may end late.
std::size_t pose_count(const SimulatorConfig& config) {
  return static_cast<std::size_t>(std::ceil((config.seconds + 0.5) / kInterval_s)) + 1;
}

// The speed factor shrinks time; the way and its pace stay as they are.
Drive make_up(const SimulatorConfig& config, const Preset& preset) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  Pace pace = preset.pace;
  pace.start_m_s = std::max(pace.start_m_s, config.start_speed_m_s);
  const double seconds = config.seconds * config.speed;
  const double length_m = std::max(pace.cruise_m_s, config.start_speed_m_s) * (seconds + kAfter_s);
  Drive drive;
  drive.corrects_every_m = kCorrection_s * preset.pace.cruise_m_s;
  drive.route = config.world == SimulatedWorld::kUrban
                    ? make_city(seed, length_m, config.loop_m)
                    : make_road(preset.road, seed, length_m, config.loop_m);
  drive.distances_m = distances_driven(drive.route.way, drive.route.stops_m, pace, kInterval_s * config.speed,
                                       seconds + kAfter_s * config.speed);
  drive.last = std::min(pose_count(config), drive.distances_m.size()) - 1;
  return drive;
}

void refuse_what_a_path_decides(const SimulatorConfig& config) {
  const auto refuse = [](const char* key) {
    throw Error(std::string("simulator.") + key, "shapes a made-up drive only, and simulator.path is set",
                std::string("leave out one of them"));
  };
  if (config.loop_m > 0.0) refuse("loop_m");
  if (config.start_speed_m_s > 0.0) refuse("start_speed_m_s");
}

Drive follow(const SimulatorConfig& config, const Preset& preset) {
  refuse_what_a_path_decides(config);
  RecordedPath path = read_path(config.path, preset.road.half_width_m, preset.road.lane_m);
  const double first_s = RecordedPath::kInterval_s * config.path_first, left_s = path.duration_s() - first_s;
  constexpr double kShortest_s = 1.0;
  if (left_s < kShortest_s)
    throw Error("simulator.path_first",
                format("%d leaves less than a second of ", config.path_first) + config.path,
                format("it has %zu poses", path.distances_m.size()));
  Drive drive;
  const auto end = static_cast<std::size_t>(left_s / config.speed / kInterval_s);
  drive.last = std::min(pose_count(config) - 1, end);
  const std::size_t after = drive.last + static_cast<std::size_t>(kAfter_s / kInterval_s);
  for (std::size_t i = 0; i <= std::min(after, end); ++i)
    drive.distances_m.push_back(
        path.distance_m(first_s + config.speed * kInterval_s * static_cast<double>(i)));
  drive.route = std::move(path.route);
  return drive;
}

/// What must stay free for the vehicle, as a street of its own.
StreetMap free_way(const Way& way) {
  std::vector<StreetPoint> points = street_along(way.line(), 0);
  for (StreetPoint& point : points) point.half_width_m = kVehicleHalf_m;
  return StreetMap(std::move(points));
}

}  // namespace

Surroundings lay_out(const SimulatorConfig& config) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  const Preset preset = preset_of(config.world);
  Drive drive = config.path.empty() ? make_up(config, preset) : follow(config, preset);
  Ground ground(StreetMap(std::move(drive.route.streets)), preset.ground, seed);
  const Way& way = drive.route.way;
  const std::vector<Eigen::Isometry3d> poses =
      drive_over(ground, way, std::span(drive.distances_m).first(drive.last + 1), kInterval_s,
                 drive.corrects_every_m, seed);

  Surroundings result;
  result.T_world_base = std::make_unique<Trajectory>(poses, kInterval_s);
  result.world = std::make_unique<World>(std::move(ground), free_way(way), preset.scenery, seed);
  result.traffic =
      std::make_unique<Traffic>(preset.traffic, config.traffic, way, std::move(drive.distances_m),
                                kInterval_s, &result.world->ground(), seed);
  return result;
}

}  // namespace pago::simulator
