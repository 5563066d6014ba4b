// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "pago/config/mapping.hpp"

namespace pago::mapping {

/// Features of a sweep or of a map, by kind.
struct FeatureClouds {
  std::vector<Eigen::Vector3f> edges, planars;
};

/// Keyframes with their features, and the map made of those around: LeGO-LOAM's extractSurroundingKeyFrames.
/// Grows with the drive, about 50 kB per keyframe. [one thread]
class KeyframeStore {
 public:
  explicit KeyframeStore(const KeyframeMapConfig& config) : config_(config) {}

  void clear() { frames_.clear(); }
  std::size_t size() const noexcept { return frames_.size(); }

  /// `clouds` in the sensor frame; edges and planars are moved to the map, and thinned as they are (planars
  /// and outliers apart from each other).
  void add(const Eigen::Isometry3d& T_map_sensor, const FeatureClouds& clouds);

  const Eigen::Vector3d& last_position() const noexcept { return frames_.back().position; }

  /// The keyframes within the radius of a place, one per voxel of config.thinning_m: that of the mean index
  /// of those in the voxel, as in LeGO-LOAM, which where a place is visited twice may be one of neither
  /// visit.
  std::vector<std::size_t> around(const Eigen::Vector3d& place) const;

  /// The features of these keyframes, thinned.
  FeatureClouds map_around(const Eigen::Vector3d& place) const;

 private:
  struct Frame {
    Eigen::Vector3d position;
    FeatureClouds in_map;
  };

  KeyframeMapConfig config_;
  std::vector<Frame> frames_;
};

}  // namespace pago::mapping
