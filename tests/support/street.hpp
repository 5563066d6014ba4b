// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "pago/core/se3.hpp"
#include "pago/core/sweep.hpp"

namespace pago::test {

/// A small street of exact geometry for odometry tests: level ground, house fronts with recesses, poles. Each
/// ray leaves from the sensor's pose at its own firing time, so that sweeps are distorted by the motion as
/// real ones are.
class Street {
 public:
  struct Wall {
    Eigen::Vector2d from, to;
    double top_m;
  };
  struct Pole {
    Eigen::Vector2d at;
    double radius_m;
  };

  Street() {
    for (int i = -6; i < 14; ++i) {
      const double x = 12.0 * i, recess = i % 2 == 0 ? 0.0 : 1.5;
      walls_.push_back({{x, 9.0 + recess}, {x + 12.0, 9.0 + recess}, 8.0});
      walls_.push_back({{x, -11.0 - recess}, {x + 12.0, -11.0 - recess}, 6.0});
      walls_.push_back({{x, 9.0}, {x, 10.5}, 8.0});
      walls_.push_back({{x, -11.0}, {x, -12.5}, 6.0});
      poles_.push_back({{x + 3.0, 6.0}, 0.12});
      poles_.push_back({{x + 8.0, -7.0}, 0.15});
    }
    walls_.push_back({{170.0, -30.0}, {170.0, 30.0}, 10.0});
    walls_.push_back({{-75.0, -30.0}, {-75.0, 30.0}, 10.0});
  }

  /// Range of a ray from `origin` (world) along the unit vector `direction`, up to 100 m.
  std::optional<double> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double best = 100.0;
    if (direction.z() < -1e-9) best = std::min(best, -origin.z() / direction.z());
    for (const Wall& wall : walls_) {
      const Eigen::Vector2d along = wall.to - wall.from, offset = wall.from - origin.head<2>();
      const double determinant = direction.y() * along.x() - direction.x() * along.y();
      if (std::abs(determinant) < 1e-12) continue;
      const double range = (offset.y() * along.x() - offset.x() * along.y()) / determinant;
      const double position = (direction.x() * offset.y() - direction.y() * offset.x()) / determinant;
      if (range > 0.0 && range < best && position >= 0.0 && position <= 1.0 &&
          origin.z() + range * direction.z() < wall.top_m) {
        best = range;
      }
    }
    for (const Pole& pole : poles_) {
      const Eigen::Vector2d offset = origin.head<2>() - pole.at, d = direction.head<2>();
      const double a = d.squaredNorm(), b = offset.dot(d);
      const double root = b * b - a * (offset.squaredNorm() - pole.radius_m * pole.radius_m);
      if (root < 0.0) continue;
      const double range = (-b - std::sqrt(root)) / a;
      if (range > 0.0 && range < best && origin.z() + range * direction.z() < 5.0) best = range;
    }
    return best < 100.0 ? std::optional(best) : std::nullopt;
  }

  /// Fills a sweep seen from a sensor that moves with constant `twist` (per second, sensor frame) and is at
  /// `T_world_start` when the sweep starts. Ground mask included, from the geometry. Clockwise from behind,
  /// 10 Hz.
  void scan(const Eigen::Isometry3d& T_world_start,
            const Vector6d& twist,
            std::int64_t start_ns,
            double noise_m,
            Sweep& sweep) const {
    constexpr int kColumns = 1800;
    constexpr std::int64_t kSweep_ns = 100'000'000;
    sweep.reset();
    sweep.header.start_ns = start_ns;
    sweep.header.end_ns = start_ns + kSweep_ns;
    sweep.header.num_columns = kColumns;
    sweep.header.rotation_rev = 1.0F;
    std::mt19937 random(static_cast<unsigned>(start_ns / 1000));
    std::normal_distribution<double> noise(0.0, noise_m > 0.0 ? noise_m : 1.0);
    for (int column = 0; column < kColumns; ++column) {
      const std::int64_t offset_ns = kSweep_ns * column / kColumns;
      const Eigen::Isometry3d T_world_sensor =
          T_world_start * exp_se3(twist * (static_cast<double>(offset_ns) * 1e-9));
      const double azimuth = std::numbers::pi - 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
      for (int ring = 0; ring < kNumRings; ++ring) {
        const double elevation = (-24.8 + 26.8 * ring / (kNumRings - 1)) * std::numbers::pi / 180.0;
        const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const auto range = cast(T_world_sensor.translation(), T_world_sensor.linear() * beam);
        if (!range) continue;
        const bool is_ground = (T_world_sensor * (beam * *range)).z() < 0.02;
        const Eigen::Vector3f p = (beam * (*range + (noise_m > 0.0 ? noise(random) : 0.0))).cast<float>();
        const std::uint32_t i = sweep.size++;
        sweep.x_m[i] = p.x(), sweep.y_m[i] = p.y(), sweep.z_m[i] = p.z();
        sweep.intensity[i] = 50;
        sweep.ring[i] = static_cast<std::uint8_t>(ring);
        sweep.column[i] = static_cast<std::uint16_t>(column);
        sweep.time_offset_ns[i] = static_cast<std::int32_t>(offset_ns);
        sweep.ground[i] = is_ground ? kGround : kNonGround;
        sweep.range_image.at(ring, column) = static_cast<std::int32_t>(i);
      }
    }
  }

 private:
  std::vector<Wall> walls_;
  std::vector<Pole> poles_;
};

inline constexpr std::uint32_t kStreetReturns = 64 * 1800;
inline constexpr double kStreetHeight_m = 1.73;

inline Eigen::Isometry3d street_start() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = kStreetHeight_m;
  return T;
}

}  // namespace pago::test
