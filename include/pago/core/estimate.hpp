// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>

namespace pago {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Trust in a pose. INIT: no motion estimated yet. OK: registered. DEGRADED: registered with a caveat, or
/// predicted for a few sweeps. LOST: predicted for so long that the pose should not be driven on.
enum class Health : std::uint8_t { kInit, kOk, kDegraded, kLost };

enum class HealthReason : std::uint8_t {
  kNone,
  kFirstSweep,         ///< nothing to register against
  kMotionUnknown,      ///< how the sensor moves is still being found out
  kTooFewFeatures,     ///< the sweep or its target has too few edges or planar points
  kNotObservable,      ///< some direction of motion is not constrained by what is seen
  kImplausibleMotion,  ///< the registration contradicts the motion model beyond its gate
  kNotFinite,          ///< the solver met NaN or infinity
  kIncompleteSweep,    ///< part of the rotation is missing (lost packets, overfull sweep)
  kTimeGap,            ///< sensor time went back or stood still: the motion is unknown
  kRefusedScan,        ///< Odometry was given a scan that it cannot use
  kNoData,             ///< the sensor has fallen silent: the last pose, told again
  kPoorFit,            ///< the sweep fits the local map much worse than those before it
  kMapRestarted,       ///< the local map was lost and begun anew: the pose went on by prediction in between
  kCutShort,           ///< the deadline ended the refinement before it came to rest
  kCount
};

/// Whether the motion was measured, in the directions that can be seen.
constexpr bool is_measured(HealthReason reason) noexcept {
  return reason == HealthReason::kNone || reason == HealthReason::kNotObservable;
}

std::string_view to_string(Health health) noexcept;
std::string_view to_string(HealthReason reason) noexcept;

/// What the estimate thread says of one sweep. All poses are of `sensor` in `odom` at `stamp_ns`.
struct Estimate {
  std::int64_t stamp_ns = 0;  ///< the instant the poses hold for (the configured instant of the sweep)
  Eigen::Isometry3d T_odom_sensor_front_end =
      Eigen::Isometry3d::Identity();  ///< product of scan-to-scan increments
  Eigen::Isometry3d T_odom_sensor_first =
      Eigen::Isometry3d::Identity();  ///< last refined pose * this increment
  Eigen::Isometry3d T_odom_sensor_refined = Eigen::Isometry3d::Identity();  ///< after scan-to-map
  /// Of the refined pose's last increment, right perturbation in the sensor frame, order x y z roll pitch
  /// yaw; m^2, m rad, rad^2.
  Matrix6d covariance = Matrix6d::Zero();
  /// Of the sensor, in its own frame, order x y z roll pitch yaw; m/s and rad/s.
  Vector6d twist = Vector6d::Zero();
  Health health = Health::kInit;
  HealthReason reason = HealthReason::kFirstSweep;
  bool is_keyframe = false;  ///< the saved map keeps this sweep
  bool has_pose = false;     ///< false for partial sweeps at either end of a run, superseded and refused ones

  // Scan to scan.
  std::uint16_t rounds = 0;
  std::uint32_t edge_matches = 0, planar_matches = 0;
  float edge_rms_m = 0.0F, planar_rms_m = 0.0F;

  // Scan to map.
  std::uint16_t iterations = 0;
  bool is_cut_short = false;  ///< iterations ended by the deadline
  std::uint8_t weak_directions =
      0;  ///< bit i: the i-th of x y z roll pitch yaw is not constrained by the map
  std::uint32_t map_points = 0, map_matches = 0;  ///< registered, and of these on a plane of the map
  float map_rms_m = 0.0F;
  float map_score = 0.0F;  ///< mean closeness of the points to the map's planes, 0 to 1
};

}  // namespace pago
