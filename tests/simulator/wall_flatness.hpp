// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pago/hdl64/packet_decoder.hpp"
#include "wall_scene.hpp"

namespace pago::test {

/// Calls use(point in `sensor`, sensor time in s of the drive, class) for every return, decoded with the
/// head's true azimuth.
template <typename Use>
void decode_all(WallScene& wall, Use use) {
  hdl64::PacketDecoder decoder(simulator::made_up_unit(), 0.9, 120.0);
  hdl64::PacketReturns returns{};
  for (const simulator::SimulatedPacket& packet : wall.packets()) {
    const double start_s = static_cast<double>(packet.time_ns - WallScene::kStart_ns) * 1e-9;
    const simulator::Head& head = wall.sensor.head();
    decoder.decode(
        hdl64::PacketView(packet.bytes),
        {2 * std::numbers::pi * head.revolutions(start_s), 2 * std::numbers::pi * head.rate_rev_s(start_s)},
        returns);
    for (int firing = 0; firing < hdl64::kFirings; ++firing) {
      const double t_s = start_s + firing * 48e-6;
      const hdl64::FiringReturns& of_firing = returns.strongest[static_cast<std::size_t>(firing)];
      for (std::uint64_t left = of_firing.valid; left != 0; left &= left - 1) {
        const int laser = std::countr_zero(left);
        const auto i = static_cast<std::size_t>(laser);
        const auto slot = static_cast<std::size_t>((2 * firing + laser / 32) * 32 + laser % 32);
        use(Eigen::Vector3d(of_firing.x_m[i], of_firing.y_m[i], of_firing.z_m[i]),
            t_s + hdl64::laser_time_ns(laser) * 1e-9, static_cast<simulator::Label>(packet.labels[slot]));
      }
    }
  }
}

/// The wall's or the ground's returns in the world: how far they are off their plane.
struct Flatness {
  double rms_m = 0.0, worst_steps = 0.0;  ///< worst: along the beam, in distance steps of 2 mm
  std::size_t count = 0;
};

inline Flatness flatness(WallScene& wall, simulator::Label label, bool deskews) {
  Flatness result;
  const double mid_s = 0.1;
  decode_all(wall, [&](const Eigen::Vector3d& point, double t_s, simulator::Label of) {
    if (of != label) return;
    const Eigen::Isometry3d T = wall.sensor.T_world_sensor(deskews ? t_s : mid_s);
    const Eigen::Vector3d in_world = T * point, beam = (T.linear() * point).normalized();
    const bool is_wall = label == simulator::Label::kBuilding;
    const double off = is_wall ? in_world.x() - WallScene::kWall_m : in_world.z();
    const double slant = std::abs(is_wall ? beam.x() : beam.z());
    // Near their rims the two surfaces hide each other's continuation; grazing beams see them too obliquely.
    if (slant < 0.05) return;
    result.rms_m += off * off;
    result.worst_steps = std::max(result.worst_steps, std::abs(off) / slant / 0.002);
    ++result.count;
  });
  result.rms_m = std::sqrt(result.rms_m / static_cast<double>(std::max<std::size_t>(1, result.count)));
  return result;
}

}  // namespace pago::test
