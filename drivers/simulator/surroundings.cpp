// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "surroundings.hpp"

#include <cmath>

#include "city.hpp"
#include "vehicle.hpp"

namespace pago::simulator {
namespace {

constexpr double kInterval_s = 0.02;  // between the poses of a made-up drive
constexpr double kAfter_s = 4.0;      // what drives ahead needs to know of the time after the drive
constexpr double kVehicleHalf_m = 0.9;

/// What must stay free for the vehicle, as a street of its own.
StreetMap free_way(const Way& way) {
  std::vector<StreetPoint> points = street_along(way.line(), 0);
  for (StreetPoint& point : points) point.half_width_m = kVehicleHalf_m;
  return StreetMap(std::move(points));
}

Surroundings lay_out_city(const SimulatorConfig& config) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  const Pace pace{.start_m_s = config.start_speed_m_s};
  // The speed factor shrinks time; the way and its pace stay as they are.
  const double interval_s = kInterval_s * config.speed, seconds = config.seconds * config.speed;
  const double length_m = std::max(pace.cruise_m_s, config.start_speed_m_s) * (seconds + kAfter_s);
  City city = make_city(seed, length_m);
  const GroundStyle land{.speed_bumps = 0.15};
  Ground ground(StreetMap(std::move(city.streets)), land, seed);
  std::vector<double> distances =
      distances_driven(city.way, city.stops_m, pace, interval_s, seconds + kAfter_s * config.speed);
  const std::vector<Eigen::Isometry3d> poses = drive_over(ground, city.way, distances, kInterval_s, seed);

  Surroundings result;
  // A little more, since the last rotation may end late.
  const auto count = static_cast<std::size_t>(std::ceil((config.seconds + 0.5) / kInterval_s)) + 1;
  result.T_world_base =
      std::make_unique<Trajectory>(std::span(poses).first(std::min(count, poses.size())), kInterval_s);
  result.world = std::make_unique<World>(std::move(ground), free_way(city.way), TownStyle{}, seed);
  result.traffic = std::make_unique<Traffic>(TrafficStyle{}, config.traffic, city.way, std::move(distances),
                                             kInterval_s, &result.world->ground(), seed);
  return result;
}

}  // namespace

Surroundings lay_out(const SimulatorConfig& config) {
  return lay_out_city(config);
}

}  // namespace pago::simulator
