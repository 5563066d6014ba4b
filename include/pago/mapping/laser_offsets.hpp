// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <span>

#include "pago/config/mapping.hpp"
#include "pago/core/deskew.hpp"
#include "pago/core/sweep.hpp"
#include "pago/registration/cell_map.hpp"
#include "pago/registration/point_cloud.hpp"

namespace pago::mapping {

/// What each laser measures wrong against its calibration, learned from the local map: a surface that one
/// laser has seen is seen by the others as the vehicle moves on, and what a laser is off by, on the mean, is
/// its own error. Three numbers a ring: an error of range, the same at all ranges, and those of its two
/// angles. Eight millimetres and 0.02 degrees are usual (spec/hdl64.md), and cost more accuracy than noise
/// does. Real-time safe but for the constructor; deterministic. [estimate thread]
class LaserOffsets {
 public:
  explicit LaserOffsets(const LasersConfig& config);

  /// Where a return of that ring is with what has been learned so far.
  Eigen::Vector3f corrected(const Eigen::Vector3f& p, std::uint8_t ring) const noexcept {
    const Ring& at = rings_[ring % kNumRings];
    const float level = std::max(1e-3F, std::hypot(p.x(), p.y()));
    const Eigen::Vector3f upwards(-p.x() * p.z() / level, -p.y() * p.z() / level, level);  // per radian
    const Eigen::Vector3f leftwards(-p.y(), p.x(), 0.0F);
    return p + at.offset[0] * p.normalized() + at.offset[1] * upwards + at.offset[2] * leftwards;
  }

  /// From a sweep that is registered well: `points` are corrected ones, each of the ring in `rings`, seen
  /// from `T_map_sensor`.
  void learn(registration::CellMap& map,
             const registration::PointCloud& points,
             std::span<const std::uint8_t> rings,
             const Eigen::Isometry3d& T_map_sensor,
             const MotionInSweep& motion) noexcept;

  /// So far, metres and radians: added to what the ring measures.
  float range_m(std::size_t ring) const noexcept { return rings_[ring].offset[0]; }
  float elevation_rad(std::size_t ring) const noexcept { return rings_[ring].offset[1]; }
  float azimuth_rad(std::size_t ring) const noexcept { return rings_[ring].offset[2]; }  ///< to the left

  void reset() noexcept;

 private:
  struct Ring {
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();  // range, elevation, azimuth
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  };
  LasersConfig config_;
  Eigen::Matrix3d prior_;
  std::array<Ring, kNumRings> rings_;
};

}  // namespace pago::mapping
