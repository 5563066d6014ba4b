// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "ground.hpp"
#include "models.hpp"
#include "ray_caster.hpp"
#include "way.hpp"

namespace pago::simulator {

/// One that moves: where it is along the vehicle's own way at any time, and how far beside it.
struct Mover {
  std::size_t model = 0;
  std::function<double(double t_s)> along_m;  ///< distance along the way
  double left_m = 0.0;                        ///< of the way
  double from_s = 0.0, until_s = 0.0;         ///< when it exists
};

struct TrafficStyle {
  double oncoming_per_s = 0.22;
  double oncoming_left_m = 3.2, oncoming_slow_m_s = 7.0, oncoming_fast_m_s = 13.0;
  double leading = 0.6, following = 0.5;  ///< chances
  double passing_per_s = 0.0, passing_left_m = 3.75, passing_slow_m_s = 2.0, passing_fast_m_s = 9.0;
  double pedestrians_per_m = 0.02;
  double sidewalk_right_m = 5.0, sidewalk_left_m = 8.4;
};

/// Cars and people who move while the head turns: a ray meets them where they are at its own time.
/// [one thread]; cast: no allocation, no lock.
class Traffic {
 public:
  /// Nobody.
  Traffic();
  /// `distance_m` is where the vehicle itself is along its way, every `interval_s`; the movers keep clear of
  /// it.
  Traffic(const TrafficStyle& style,
          double density,
          Way way,
          std::vector<double> distances_m,
          double interval_s,
          const Ground* ground,
          std::uint64_t seed);
  ~Traffic();
  Traffic(const Traffic&) = delete;  // movers look at the vehicle's own distances
  Traffic& operator=(const Traffic&) = delete;

  /// Finds out who is near; to be called for every few milliseconds of rays.
  void prepare(double t_s, const Eigen::Vector3d& sensor);

  /// Movers that some ray of a packet may meet, a bit each. Ray coordinates count from `origin`.
  using Candidates = std::uint64_t;
  Candidates candidates(const RayPacket& rays, const Eigen::Vector3d& origin, double t_s) const noexcept;

  /// The first of them that a ray meets within `max_m`.
  Hit cast(Candidates candidates,
           const RayPacket& rays,
           std::size_t i,
           const Eigen::Vector3d& origin,
           double t_s,
           float max_m) const noexcept;

 private:
  struct Shapes;
  /// Where one is at the beginning of an interval, through which it moves and turns evenly.
  struct Present {
    std::size_t mover = 0;
    Eigen::Isometry3d T_world_mover = Eigen::Isometry3d::Identity();
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();  ///< in its own axes
  };

  void add_cars(const TrafficStyle& style, double density, std::uint64_t seed);
  void add_pedestrians(const TrafficStyle& style, double density, std::uint64_t seed);
  double vehicle_m(double t_s) const noexcept;
  Eigen::Isometry3d pose(const Mover& mover, double t_s) const;

  Way way_;
  std::vector<double> distances_m_;
  double interval_s_ = 0.02;
  const Ground* ground_ = nullptr;
  std::unique_ptr<Shapes> shapes_;
  std::vector<Mover> movers_;
  std::vector<Present> present_;
  std::int64_t present_interval_ = -1;
};

}  // namespace pago::simulator
