// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace pago::simulator {

/// A motion without corners: a uniform cubic B-spline over poses, in translation as usual, in rotation as a
/// product of exponentials (Lovegrove, Patron-Perez and Sibley, "Spline Fusion", BMVC 2013, eq. 3-4). It
/// passes near its control poses, not through them, and has continuous velocity and acceleration; a drive's
/// truth is the spline itself, exact at every instant. [set-up] the constructor; [any thread] the rest.
class Trajectory {
 public:
  /// Two poses at least, `interval_s` apart; the motion begins at the first at 0 s and ends at the last.
  Trajectory(std::span<const Eigen::Isometry3d> T_world_body, double interval_s);

  double duration_s() const noexcept { return duration_s_; }
  /// Outside [0, duration] the pose at the nearer end.
  Eigen::Isometry3d pose(double t_s) const noexcept;

 private:
  struct Knot {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();  ///< from the knot before, in the world
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< from the knot before, in the body
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  };
  std::vector<Knot> knots_;  // one more than the poses at either end
  double interval_s_, duration_s_;
};

}  // namespace pago::simulator
