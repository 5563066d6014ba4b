// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "pago/config/mapping.hpp"
#include "pago/registration/cell_map.hpp"
#include "pago/registration/point_cloud.hpp"

namespace pago::mapping {

/// What a sweep's motion is thought to be before it is registered.
struct MotionGuess {
  Eigen::Isometry3d T_map_last = Eigen::Isometry3d::Identity();   ///< the last sweep's pose
  Eigen::Isometry3d T_last_this = Eigen::Isometry3d::Identity();  ///< start value
  Matrix6d information = Matrix6d::Zero();  ///< how much the start value is to be trusted
  double period_s = 0.0;    ///< from the last sweep's reference instant to this one's
  bool is_compensated = false;  ///< no de-skew
};

struct JointResult {
  Eigen::Isometry3d T_last_this = Eigen::Isometry3d::Identity();
  Vector6d twist = Vector6d::Zero();  ///< that the sweep was de-skewed by
  /// Right perturbation in the sensor frame, order x y z roll pitch yaw, as if residuals were independent.
  Matrix6d information = Matrix6d::Zero();
  int iterations = 0;
  std::uint32_t offered = 0, matches = 0;
  double rms_m = 0.0;  ///< robustly weighted
};

/// Scan to map, all six degrees of freedom at once: points to the planes of the local map, Gauss-Newton under a
/// Geman-McClure kernel. Each round de-skews the points with the motion found so far, so that pose and
/// distortion settle together. [set-up] constructor; [estimate thread] align(): real-time safe, deterministic.
class JointRegistration {
 public:
  JointRegistration(const MappingConfig& config, std::size_t max_points);

  JointResult align(registration::CellMap& map,
                    const registration::PointCloud& points,
                    const MotionGuess& guess) noexcept;

 private:
  struct Match {
    Eigen::Vector3f point;   // in the sensor frame at the reference instant
    Eigen::Vector3f normal;  // the same
    float residual_m;
    float variance_m2;  // of the residual
  };
  struct NormalEquations {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    double weight = 0.0, weighted_sq = 0.0;
  };

  void match(registration::CellMap& map,
             const registration::PointCloud& points,
             const Eigen::Isometry3d& T_map_this,
             const Vector6d& twist) noexcept;
  NormalEquations accumulate() noexcept;

  MappingConfig config_;
  FixedVector<Match> matches_;
  FixedVector<float> magnitudes_;
};

}  // namespace pago::mapping
