// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/sweep.hpp"
#include "pago/odometry/loam_matching.hpp"
#include "pago/odometry/registration.hpp"

namespace pago::odometry {

/// The two-step registration of LeGO-LOAM's and PaGO-LOAM's code (featureAssociation): first planar points
/// fix z, roll and pitch in all its iterations, then edges x, y and yaw. Each match is one row: the distance
/// from a line or plane through bare features, weighted linearly after the first matchings; each Gauss-Newton
/// step is taken to odometry.update_gain, and a step that is small after that ends the search. For
/// registration = loam: the paper presets and studies. Differs from that code in its rotations, which are
/// perturbed about the sensor instead of by Euler angles: the same to first order.
///
/// Not for the hot path: allocates. Deterministic. [set-up] constructor; [estimate thread] the rest.
class LoamRegistration {
 public:
  explicit LoamRegistration(const OdometryConfig& config);

  /// What the next sweeps are registered to: the sweep's edges and planars, moved to its reference instant by
  /// `twist`.
  void set_targets(const Sweep& sweep, const Vector6d& twist) noexcept;

  /// As TwoStepRegistration::align(). Planar sources on and off the ground serve step one alike.
  RegistrationResult align(const FeatureSet& sources,
                           const Eigen::Isometry3d& T_guess,
                           double period_s) noexcept;

 private:
  struct LineMatch {
    Eigen::Vector3d source, a, b;
  };
  struct PlaneMatch {
    Eigen::Vector3d source, a, b, c;
  };

  void match_planes(const PointCloud& cloud, const LoamTargets& targets) noexcept;
  void match_lines(const PointCloud& cloud) noexcept;
  template <typename Associate, typename AddRows>
  int run_step(const std::array<int, 3>& dofs, Associate associate, AddRows add_rows) noexcept;
  void add_row(const Eigen::Vector3d& source,
               const Offset& offset,
               double range_factor,
               bool is_weighted) noexcept;
  void add_plane_rows(bool is_weighted) noexcept;
  void add_line_rows(bool is_weighted) noexcept;
  bool has_targets() const noexcept;

  OdometryConfig config_;
  LoamTargets edges_, ground_, others_;  // all planar ones in ground_ unless surfaces are told apart
  std::vector<LineMatch> lines_;
  std::vector<PlaneMatch> planes_;
  std::vector<registration::Row> rows_;
  PointCloud deskewed_;
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::odometry
