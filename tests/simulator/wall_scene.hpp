// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "drivers/simulator/packet_stream.hpp"
#include "pago/core/se3.hpp"
#include "pago/simulator/unit.hpp"

namespace pago::test {

/// A wall on level ground, and a sensor that passes it in a bend.
struct WallScene {
  static constexpr double kWall_m = 40.0;  ///< its x
  static constexpr std::int64_t kStart_ns = 1'772'446'500'000'000'000;

  struct Settings {
    double speed_m_s = 12.0, turn_rad_s = 0.6;
    double noise_m = 0.0;
    std::uint64_t packets = 700;
  };

  explicit WallScene(const Settings& settings)
      : trajectory(bend(settings), 0.1),
        scene([](const simulator::Tile& tile) {
          return tile == simulator::Tile{0, 0} ? mesh() : simulator::Mesh{};
        }),
        sensor(setup(settings), trajectory),
        stream(sensor,
               scene,
               traffic,
               simulator::StatusCycle(simulator::made_up_unit(), 10.0, false, 0),
               {PacketStamp::kFirstFiring, kStart_ns, settings.packets, 1}) {}

  static simulator::SensorSetup setup(const Settings& settings) {
    simulator::SensorSetup setup;
    setup.unit = simulator::made_up_unit();
    setup.returns.range_noise_m = settings.noise_m;
    setup.T_base_sensor.translation().z() = 1.73;
    setup.has_wide_beams = setup.has_dropouts = setup.has_roof = false;
    return setup;
  }
  static simulator::Mesh mesh() {
    simulator::Mesh mesh;
    add_quad(mesh,
             {Eigen::Vector3d(kWall_m, -60, -1), {kWall_m, 100, -1}, {kWall_m, 100, 12}, {kWall_m, -60, 12}},
             {simulator::Material::kPlaster, 200, simulator::Label::kBuilding});
    add_quad(mesh, {Eigen::Vector3d(-90, -90, 0), {140, -90, 0}, {140, 140, 0}, {-90, 140, 0}},
             {simulator::Material::kConcrete, 200, simulator::Label::kRoad});
    return mesh;
  }
  static std::vector<Eigen::Isometry3d> bend(const Settings& settings) {
    std::vector<Eigen::Isometry3d> poses;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << 20.0, 10.0, 0.0;
    Vector6d step = Vector6d::Zero();
    step[0] = 0.1 * settings.speed_m_s;
    step[5] = 0.1 * settings.turn_rad_s;
    for (int i = 0; i < 8; ++i, T = T * exp_se3(step)) poses.push_back(T);
    return poses;
  }

  std::vector<simulator::SimulatedPacket> packets() {
    std::vector<simulator::SimulatedPacket> all;
    for (simulator::SimulatedPacket packet; stream.next(packet);) all.push_back(packet);
    return all;
  }

  simulator::Trajectory trajectory;
  simulator::RayCaster scene;
  simulator::Traffic traffic;
  simulator::Sensor sensor;
  simulator::PacketStream stream;
};

}  // namespace pago::test
