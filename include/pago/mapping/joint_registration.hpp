// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "pago/config/mapping.hpp"
#include "pago/core/budget.hpp"
#include "pago/core/deskew.hpp"
#include "pago/registration/cell_map.hpp"
#include "pago/registration/point_cloud.hpp"
#include "pago/registration/rows.hpp"
#include "pago/registration/timed_equations.hpp"

namespace pago::mapping {

/// What a sweep's motion is thought to be before it is registered.
struct MotionGuess {
  Eigen::Isometry3d T_map_last = Eigen::Isometry3d::Identity();   ///< the last sweep's pose
  Eigen::Isometry3d T_last_this = Eigen::Isometry3d::Identity();  ///< start value
  /// How much the start value is trusted; right perturbation in the sensor frame, x y z roll pitch yaw.
  Matrix6d information = Matrix6d::Zero();
  bool is_carried = false;  ///< it is the motion before, carried on: no sweep has told it
  double period_s = 0.0;    ///< from the last sweep's reference instant to this one's; 0: no de-skew
  /// De-skew by this instead of by what is found: after a leap the motion since the last sweep is no
  /// velocity.
  std::optional<Vector6d> twist = std::nullopt;
  /// The velocity changes so fast (per s^2): what it is at the reference instant, and how it changes within
  /// the sweep, is found along with the motion, held to what this makes expect. Without it the velocity is
  /// that since the last sweep.
  std::optional<Vector6d> acceleration = std::nullopt;
  Vector6d acceleration_sigma = Vector6d::Ones();  ///< how far that may be off; > 0
};

/// How far a registration looks, and how long.
struct JointLimits {
  double gate_m = 1.0;
  double kernel_min_m = 0.05;
  int max_iterations = 8;
  std::size_t stride = 1;          ///< of the points every so many
  bool thins_ground_only = false;  ///< the others all count: ground says nothing of where one is in plan
  bool keeps_weak = true;          ///< no step along directions that are not observable
  /// Begin here instead of at the guess, which stays what the result is held against.
  std::optional<Eigen::Isometry3d> T_first = std::nullopt;
};

struct JointResult {
  Eigen::Isometry3d T_last_this = Eigen::Isometry3d::Identity();
  MotionInSweep within;  ///< about the reference instant: what points were de-skewed by
  /// Of the matches alone; as MotionGuess::information.
  Matrix6d information = Matrix6d::Zero();
  registration::WeakDirections weak;     ///< no step was taken along these
  registration::WeakDirections doubted;  ///< these, and those that too few places speak for to be trusted
  int iterations = 0;
  bool is_cut = false;  ///< the budget was spent before the search came to rest
  std::uint32_t offered = 0, matches = 0;
  double rms_m = 0.0;  ///< robustly weighted
  double score = 0.0;  ///< how well the points are explained, 0 to 1: mean closeness, 0 for the unmatched
};

/// Scan to map, all six degrees of freedom at once: points to the planes of the local map, Gauss-Newton under
/// a Geman-McClure kernel. Each round de-skews the points with the motion found so far, so that pose and
/// distortion settle together. Directions that the planes do not constrain keep the start value.
/// [set-up] constructor; [estimate thread] align(): real-time safe, deterministic but for the budget.
class JointRegistration {
 public:
  JointRegistration(const MappingConfig& config, std::size_t max_points);

  JointResult align(registration::CellMap& map,
                    const registration::PointCloud& points,
                    const MotionGuess& guess,
                    const JointLimits& limits,
                    const Budget& budget = kUnlimited) noexcept;

 private:
  void match(registration::CellMap& map,
             const registration::PointCloud& points,
             const Eigen::Isometry3d& T_map_this,
             const MotionInSweep& motion,
             const JointLimits& limits) noexcept;
  void weigh(double kernel_min_m) noexcept;
  void measure(JointResult& result) const noexcept;

  MappingConfig config_;
  registration::Rows rows_;
  registration::TimedEquations equations_;
  FixedVector<float> before_s_;  // of each row's point
  FixedVector<float> magnitudes_;
};

}  // namespace pago::mapping
