// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "pago/config/odometry.hpp"
#include "pago/odometry/targets.hpp"
#include "pago/registration/rows.hpp"

namespace pago::odometry {

struct RegistrationResult {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /// Right perturbation in the source frame, order x y z roll pitch yaw, as if residuals were independent;
  /// nothing about weak directions.
  Matrix6d information = Matrix6d::Zero();
  registration::WeakDirections weak;
  int rounds = 0;
  std::uint32_t ground_matches = 0, edge_matches = 0, wall_matches = 0;
  double ground_rms_m = 0.0, edge_rms_m = 0.0;  ///< robustly weighted; the latter of all of step two
};

/// The paper's two-step registration: ground points fix z, roll and pitch; then, with these held, edges (and,
/// where configured, planar points off the ground) fix x, y and yaw. Rounds of matching and Gauss-Newton
/// steps under a robust kernel; in each round the sources are de-skewed with the motion found so far.
/// Directions that nothing constrains keep the guess. [set-up] constructor; [estimate thread] align():
/// real-time safe, deterministic.
class TwoStepRegistration {
 public:
  TwoStepRegistration(const OdometryConfig& config, std::size_t max_sources);

  /// `period_s`: time from the target's to the source's reference instant, which turns the motion into a
  /// velocity; 0 for sweeps that are compensated already (no de-skew).
  RegistrationResult align(const FeatureSet& sources,
                           Targets& targets,
                           const Eigen::Isometry3d& T_guess,
                           double period_s) noexcept;

 private:
  enum class Shape { kPlane, kLine };
  using Matches = FixedVector<Match>;
  using NormalEquations = registration::NormalEquations;

  void deskew_sources(const FeatureSet& sources, double period_s) noexcept;
  void match_step_one(Targets& targets) noexcept;
  void match_step_two(Targets& targets) noexcept;
  template <typename Find>
  void match(const PointCloud& cloud, Find find, Matches& out) noexcept;
  /// The rows of a step at the present motion, after those that are in the list already.
  void add_rows(const Matches& matches, Shape shape) noexcept;
  void weigh(std::span<registration::Row> rows, Shape shape) noexcept;
  void solve(const std::array<int, 3>& dofs, const Matrix6d& penalty) noexcept;
  void finish(RegistrationResult& result) noexcept;

  OdometryConfig config_;
  FeatureSet deskewed_;
  Matches ground_, edges_, walls_;
  registration::Rows rows_;
  FixedVector<float> ranges_m_, magnitudes_;  // of the matches whose rows were added last
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
  int round_ = 0;
};

}  // namespace pago::odometry
