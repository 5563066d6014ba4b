// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "keyframe_store.hpp"
#include "pago/core/estimate.hpp"
#include "pago/registration/kd_tree.hpp"
#include "pago/registration/rows.hpp"

namespace pago::mapping {

struct FivePointResult {
  Eigen::Isometry3d T_map_sensor = Eigen::Isometry3d::Identity();
  Matrix6d H = Matrix6d::Zero();  ///< sum of w J J^T at the end; right perturbation, x y z roll pitch yaw
  int iterations = 0;
  std::uint32_t offered = 0, matches = 0;
  double rms_m = 0.0;
  bool is_registered = false;  ///< there was enough to match with
};

/// The row of a point for the line or plane through its five neighbours in the map, weighted as in LOAM's
/// mapping: by 1 - 0.9 |distance|, for planes over the square root of how far the point is from the origin of
/// the *map* (LOAM's code, kept). Nothing where that leaves a tenth or less.
std::optional<registration::Row> map_row(const Eigen::Isometry3d& T_map_sensor,
                                         const Eigen::Vector3d& source,
                                         const Eigen::Vector3d& normal,
                                         double distance_m,
                                         double range_factor) noexcept;

/// Scan to map as in LeGO-LOAM's and PaGO-LOAM's code (scan2MapOptimization): up to ten rounds of matching
/// with five neighbours and one undamped Gauss-Newton step in all six degrees of freedom. Allocates;
/// deterministic. [one thread]
class FivePointRegistration {
 public:
  explicit FivePointRegistration(const KeyframeMapConfig& config) : config_(config) {}

  FivePointResult align(FeatureClouds map, const FeatureClouds& scan, const Eigen::Isometry3d& T_guess);

 private:
  void match(const FeatureClouds& scan, const Eigen::Isometry3d& T_map_sensor);

  KeyframeMapConfig config_;
  registration::KdTree edges_, planars_;
  std::vector<registration::Row> rows_;
};

}  // namespace pago::mapping
