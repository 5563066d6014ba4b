// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "pago/core/se3.hpp"
#include "pago/core/sweep.hpp"

/// A yardstick for tables of accuracy: plain point-to-point odometry against a local map, after I. Vizzo et
/// al., "KISS-ICP: In Defense of Point-to-Point ICP", RA-L 2023. Every number is the paper's, none is a
/// setting: what cannot be tuned away can be compared across drives. It uses none of PaGO's stages, and is
/// neither real-time safe nor meant to be. [one thread]
namespace pago::baseline {

using Points = std::vector<Eigen::Vector3d>;

/// Points in a grid of cubes, at most 20 in each; those that come later are left out.
class VoxelMap {
 public:
  void add(const Points& points, const Eigen::Isometry3d& T_map_points);
  /// Forgets the cubes that lie farther than `range_m` from `centre_m`.
  void keep_around(const Eigen::Vector3d& centre_m, double range_m);
  /// The closest point of the cube that the point is in and of the 26 around it; null if they are empty.
  const Eigen::Vector3d* nearest(const Eigen::Vector3d& point_m) const;
  bool is_empty() const noexcept { return cubes_.empty(); }

 private:
  static constexpr std::size_t kMostPoints = 20;
  struct Cube {
    std::uint32_t size = 0;
    std::array<Eigen::Vector3d, kMostPoints> points_m;
  };
  std::unordered_map<std::uint64_t, Cube> cubes_;
};

/// How far a match may be, by how much registration has corrected the predictions so far (section III.C).
class AdaptiveThreshold {
 public:
  double sigma_m() const noexcept;
  void add(const Eigen::Isometry3d& correction) noexcept;

 private:
  double sum_m2_ = 0.0;
  int count_ = 0;
};

/// A pose with the velocity at which it was reached.
struct MovingPose {
  std::int64_t reference_ns = 0;  ///< sensor time of the sweep's middle, for which the pose holds
  Eigen::Isometry3d T_odom_sensor = Eigen::Isometry3d::Identity();
  Vector6d twist = Vector6d::Zero();  ///< per second, sensor frame

  Eigen::Isometry3d at(std::int64_t sensor_ns) const noexcept;
};

class Odometry {
 public:
  /// The frame `odom` is the sensor's at the first sweep. A sweep without points near the map is carried on
  /// at constant velocity.
  const MovingPose& add(const Sweep& sweep);

 private:
  Points deskewed(const Sweep& sweep) const;
  Eigen::Isometry3d align(const Points& points, Eigen::Isometry3d T_odom_sensor) const;

  VoxelMap map_;
  AdaptiveThreshold threshold_;
  MovingPose pose_;
  bool has_pose_ = false;
};

}  // namespace pago::baseline
