// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "pago/config/odometry.hpp"
#include "pago/odometry/targets.hpp"

namespace pago::odometry {

struct RegistrationResult {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /// Right perturbation in the source frame, order x y z roll pitch yaw, as if residuals were
  /// independent.
  Matrix6d information = Matrix6d::Zero();
  int rounds = 0;
  std::uint32_t ground_matches = 0, edge_matches = 0, wall_matches = 0;
  double ground_rms_m = 0.0, edge_rms_m = 0.0;  ///< robustly weighted
  /// How well step two's sources are explained, 0 to 2: mean closeness of edges plus that of walls, unmatched
  /// ones 0.
  double score = 0.0;
};

/// The paper's two-step registration: ground points fix z, roll and pitch; then, with these held, edges (and,
/// where configured, planar points off the ground) fix x, y and yaw. Rounds of matching and Gauss-Newton
/// steps under a Geman-McClure kernel; in each round the sources are de-skewed with the motion found so far.
/// [set-up] constructor; [estimate thread] align(): real-time safe, deterministic.
class TwoStepRegistration {
 public:
  TwoStepRegistration(const OdometryConfig& config, std::size_t max_sources);

  /// `period_s`: time from the target's to the source's reference instant, which turns the motion into a
  /// velocity; 0 for sweeps that are compensated already (no de-skew).
  RegistrationResult align(const FeatureSet& sources,
                           Targets& targets,
                           const Eigen::Isometry3d& T_guess,
                           double period_s,
                           double match_radius_m) noexcept;

 private:
  enum class Shape { kPlane, kLine };
  struct NormalEquations {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    double weight = 0.0, weighted_sq = 0.0;

    double rms_m() const noexcept { return weight > 0.0 ? std::sqrt(weighted_sq / weight) : 0.0; }
  };
  using Matches = FixedVector<Match>;

  void deskew_sources(const FeatureSet& sources, double period_s) noexcept;
  template <typename Find>
  void match(const PointCloud& cloud, Find find, Matches& out) noexcept;
  double residual(const Match& match, Shape shape) const noexcept;
  double kernel_width(const Matches& matches, Shape shape) noexcept;
  void accumulate(const Matches& matches, Shape shape, NormalEquations& sum) noexcept;
  void step(const NormalEquations& sum, const std::array<int, 3>& dofs) noexcept;
  double support(const Matches& matches, Shape shape, std::size_t offered) const noexcept;
  void finish(const FeatureSet& sources, RegistrationResult& result) noexcept;

  OdometryConfig config_;
  FeatureSet deskewed_;
  Matches ground_, edges_, walls_;
  FixedVector<double> residuals_;
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::odometry
