// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "head.hpp"
#include "laser_line.hpp"
#include "pago/simulator/trajectory.hpp"
#include "ray_caster.hpp"
#include "returns.hpp"
#include "timing.hpp"
#include "traffic.hpp"

namespace pago::simulator {

/// What a packet says of one laser in one firing.
struct Slot {
  std::uint16_t raw = 0;  ///< 0: no return
  std::uint8_t intensity = 0;
  Label label = Label::kUnlabelled;
};
/// All lasers of one firing; [1] is the second return.
using FiringSlots = std::array<std::array<Slot, hdl64::kLasers>, 2>;

/// A unit, how it turns, and how it is carried.
struct SensorSetup {
  hdl64::Calibration unit;  ///< as it really is, not as its file says
  FiringTiming timing;
  double rotation_hz = 10.0;
  double head_stops_at_s = 0.0;  ///< 0: never
  ReturnModel returns;
  Eigen::Isometry3d T_base_sensor = Eigen::Isometry3d::Identity();
  bool has_uneven_ground = false;  ///< hollows and rises too small for the mesh (materials.hpp)
  std::uint64_t seed = 0;
  bool has_wide_beams = true;  ///< false: each is a line, and no edge cuts it
  bool has_dropouts = true;    ///< false: none but those that are too weak
  bool has_roof = true;        ///< below the sensor; it hides some beams (roof.hpp)
};

/// Fires the lasers: each from where the sensor is at its own firing time, at its own azimuth.
/// [one thread] deterministic: what a firing sees depends on its number alone.
class Sensor {
 public:
  static constexpr int kBlock =
      48;  ///< firings that are cast together, so that neighbouring beams share work

  Sensor(SensorSetup setup, const Trajectory& T_world_base);

  /// Fills slots[0 .. kBlock) with firings first, first + 1, ...
  void fire(std::int64_t first, RayCaster& scene, Traffic& traffic, std::span<FiringSlots, kBlock> slots);

  const Head& head() const noexcept { return head_; }
  const FiringTiming& timing() const noexcept { return setup_.timing; }
  double firing_s(std::int64_t firing) const noexcept {
    return static_cast<double>(firing * setup_.timing.period_ns) * 1e-9;
  }
  Eigen::Isometry3d T_world_sensor(double t_s) const noexcept {
    return trajectory_.pose(t_s) * setup_.T_base_sensor;
  }

 private:
  /// Of one firing: pose at its start, and the way to the next one's.
  struct Stand {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d position, step, turn;
    double cos_azimuth, sin_azimuth;
  };
  /// One beam on its way.
  struct Beam {
    Heading heading;
    Eigen::Matrix3d R_world_sensor;
    Line line;  ///< in the sensor's frame
    double t_s;
  };
  /// Beams of one laser in firings one after the other, and what belongs to each.
  struct Volley {
    std::size_t laser = 0, from = 0;  ///< the first of the firings in the block
    std::int64_t first = 0;           ///< firing of the block's beginning
    std::array<Beam, RayPacket::kSize> beams;
    std::array<Random, RayPacket::kSize> random;
    RayPacket rays, aside;
    std::array<Hit, RayPacket::kSize> hits, aside_hits;
    Traffic::Candidates movers = 0;
  };

  void take_stand(std::int64_t first);
  void aim(Volley& volley, const Eigen::Vector3d& origin) const;
  void spread(Volley& volley) const;
  Returns sense(Volley& volley, std::size_t i, const RayCaster& scene, const Traffic& traffic) const;
  Echo echo_of(const Volley& volley,
               std::size_t i,
               const RayPacket& rays,
               const Hit& hit,
               const Eigen::Vector3d& origin) const noexcept;
  Slot slot_of(std::size_t laser, const Return& from) const noexcept;

  SensorSetup setup_;
  const Trajectory& trajectory_;
  Head head_;
  std::array<LaserLine, hdl64::kLasers> lines_;
  std::array<LaserOptics, hdl64::kLasers> optics_{};
  std::array<double, hdl64::kLasers> cos_delta_{}, sin_delta_{};
  std::vector<Stand> stands_;
};

}  // namespace pago::simulator
