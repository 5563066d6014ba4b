// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "pago/core/mount.hpp"
#include "pago/core/semantic_kitti.hpp"
#include "pago/core/sweep.hpp"

namespace pago::test {

/// The vertical angles of an HDL-64E (user's manual): 32 lower lasers 1/2 degree apart, 32 upper ones 1/3.
inline double hdl64_elevation_rad(int ring) {
  const double deg = ring < 32 ? -24.0 - 1.0 / 3.0 + ring / 2.0 : -8.0 - 1.0 / 3.0 + (ring - 32) / 3.0;
  return deg * std::numbers::pi / 180.0;
}

struct ScanOptions {
  Mount mount{};
  int columns = 2083;    ///< 48 us firings at 10 Hz
  double noise_m = 0.0;  ///< standard deviation of the range
  std::uint32_t seed = 1;
  double max_range_m = 120.0;
};

/// A standing world of exact geometry in `base_link` (origin on the ground below the sensor), and what each
/// of its surfaces is. Small enough to see what a test means:
///
///   Scene scene;
///   scene.level_ground().box({8, -1, 0}, {12, 1, 1.5});      // a car ahead
///   const auto truth = scene.scan(sweep);                    // truth[i]: kGround or kNonGround
class Scene {
 public:
  /// The plane z = height + grade_x x + grade_y y, where from_x_m <= x < until_x_m; grade 0.1 = 10 %.
  Scene& ground(double grade_x,
                double grade_y = 0.0,
                double height_m = 0.0,
                double from_x_m = -kEverywhere,
                double until_x_m = kEverywhere) {
    planes_.push_back({{-grade_x, -grade_y, 1.0}, height_m, from_x_m, until_x_m});
    return *this;
  }
  Scene& level_ground() { return ground(0.0); }

  /// Makes every plane wavy where |y| > beyond_m: up and down by `height_m`, `length_m` from crest to crest
  /// along x and along y.
  Scene& bumps(double height_m, double length_m, double beyond_m = -1.0) {
    bumps_.push_back({height_m, 2.0 * std::numbers::pi / length_m, beyond_m});
    return *this;
  }

  /// Level up to x = start_m, then rising by `grade`, or falling.
  Scene& ramp(double grade, double start_m) {
    ground(0.0, 0.0, 0.0, -kEverywhere, start_m);
    return ground(grade, 0.0, -grade * start_m, start_m);
  }

  /// An axis-aligned solid. As `surface` kGround it is a pavement or a kerb, else a car, a wall, a bridge.
  Scene& box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, std::uint8_t surface = kNonGround) {
    boxes_.push_back({{min, max}, surface});
    return *this;
  }

  /// Fills the sweep with one clockwise rotation that starts behind the vehicle, firing by firing, each
  /// firing from the lowest ring up; range image, times and labels included. Returns what each return hit.
  std::vector<std::uint8_t> scan(Sweep& sweep, const ScanOptions& options = {}) const {
    const Eigen::Isometry3d T_base_sensor = options.mount.T_base_sensor();
    std::mt19937 random(options.seed);
    std::normal_distribution<double> noise;
    std::vector<std::uint8_t> truth;
    start(sweep, options);
    for (int column = 0; column < options.columns; ++column) {
      const double azimuth = std::numbers::pi * (1.0 - 2.0 * (column + 0.5) / options.columns);
      for (int ring = 0; ring < kNumRings; ++ring) {
        const double elevation = hdl64_elevation_rad(ring);
        const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const Hit hit = cast(T_base_sensor.translation(), T_base_sensor.linear() * beam);
        if (!(hit.range_m <= options.max_range_m)) continue;
        add(sweep, beam * (hit.range_m + options.noise_m * noise(random)), ring, column);
        constexpr std::uint16_t kBuilding = 50;
        sweep.label[sweep.size - 1] = hit.surface == kGround ? semantic_kitti::kRoad : kBuilding;
        truth.push_back(hit.surface);
      }
    }
    return truth;
  }

 private:
  static constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  struct Plane {
    Eigen::Vector3d normal;
    double height_m, from_x_m, until_x_m;
  };
  struct Box {
    Eigen::AlignedBox3d extent;
    std::uint8_t surface;
  };
  struct Hit {
    double range_m = std::numeric_limits<double>::infinity();
    std::uint8_t surface = kNonGround;
  };

  static void start(Sweep& sweep, const ScanOptions& options) {
    constexpr std::int64_t kFiring_ns = 48'000;
    sweep.reset();
    sweep.header.num_columns = static_cast<std::uint32_t>(options.columns);
    sweep.header.firings_received = sweep.header.num_columns;
    sweep.header.rotation_rev = 1.0F;
    sweep.header.end_ns = kFiring_ns * options.columns;
    sweep.header.flags = kLabelled;
  }

  static void add(Sweep& sweep, const Eigen::Vector3d& point, int ring, int column) {
    const std::uint32_t i = sweep.size++;
    sweep.x_m[i] = static_cast<float>(point.x());
    sweep.y_m[i] = static_cast<float>(point.y());
    sweep.z_m[i] = static_cast<float>(point.z());
    sweep.intensity[i] = 100;
    sweep.ring[i] = static_cast<std::uint8_t>(ring);
    sweep.column[i] = static_cast<std::uint16_t>(column);
    sweep.time_offset_ns[i] = 48'000 * column;
    sweep.range_image.at(ring, column) = static_cast<std::int32_t>(i);
  }

  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    Hit nearest;
    for (const Plane& plane : planes_) {
      const double range_m = meet(plane, origin, direction);
      const double x_m = origin.x() + range_m * direction.x();
      const bool is_there = x_m >= plane.from_x_m && x_m < plane.until_x_m;
      if (range_m > 0.0 && range_m < nearest.range_m && is_there) nearest = {range_m, kGround};
    }
    for (const Box& box : boxes_) {
      const double range_m = enter(box.extent, origin, direction);
      if (range_m > 0.0 && range_m < nearest.range_m) nearest = {range_m, box.surface};
    }
    return nearest;
  }

  double bump(const Eigen::Vector3d& p) const {
    double height_m = 0.0;
    for (const Bump& b : bumps_)
      if (std::abs(p.y()) > b.beyond_m)
        height_m += b.height_m * std::sin(b.per_m * p.x()) * std::cos(b.per_m * p.y());
    return height_m;
  }

  /// Range at which a ray meets a plane; with bumps, roughly where it first goes under the ground.
  double meet(const Plane& plane, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    const auto above_m = [&](double range_m) {
      const Eigen::Vector3d p = origin + range_m * direction;
      return plane.normal.dot(p) - plane.height_m - bump(p);
    };
    if (bumps_.empty()) return (plane.height_m - plane.normal.dot(origin)) / plane.normal.dot(direction);
    double low = 0.0, high = 0.5;
    while (above_m(high) > 0.0) {
      low = high;
      high += 0.02 * high + 0.1;
      if (high > 200.0) return kEverywhere;
    }
    for (int i = 0; i < 30; ++i) (above_m(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return high;
  }

  /// Range at which a ray enters a box, infinite if it misses.
  static double enter(const Eigen::AlignedBox3d& box,
                      const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction) {
    const Eigen::Array3d to_min = (box.min() - origin).array() / direction.array();
    const Eigen::Array3d to_max = (box.max() - origin).array() / direction.array();
    const double first = to_min.min(to_max).maxCoeff();
    const double last = to_min.max(to_max).minCoeff();
    return first <= last ? first : std::numeric_limits<double>::infinity();
  }

  struct Bump {
    double height_m, per_m, beyond_m;
  };
  std::vector<Bump> bumps_;
  std::vector<Plane> planes_;
  std::vector<Box> boxes_;
};

}  // namespace pago::test
