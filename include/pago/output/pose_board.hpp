// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "pago/config/output.hpp"
#include "pago/core/mount.hpp"
#include "pago/core/sweep.hpp"
#include "pago/output/pose_v1.h"

namespace pago::output {

using PoseV1 = pago_pose_v1;
enum class PoseKind : std::uint8_t { kFirst = PAGO_POSE_FIRST, kRefined = PAGO_POSE_REFINED };

/// Turns estimates into poses for others: of the sensor in `odom`, or of `base_link`, whose `odom` then
/// begins on the ground below the first pose. [any thread] real-time safe.
class PoseMaker {
 public:
  PoseMaker(PoseChild child, const Mount& mount);

  /// Needs a sweep with a pose. `published_ns` is left 0.
  PoseV1 make(const Sweep& sweep, PoseKind kind) const noexcept;

  /// T_odom_child of a pose of the sensor.
  Eigen::Isometry3d child_pose(const Eigen::Isometry3d& T_odom_sensor) const noexcept;

 private:
  PoseChild child_;
  Eigen::Isometry3d T_child_sensor_ = Eigen::Isometry3d::Identity();
  Matrix6d adjoint_ = Matrix6d::Identity();  // of T_child_sensor_
};

/// Where the newest poses can be seen by other processes: a piece of shared memory, as pose_v1.h describes.
/// The object goes when its owner does; one that a killed process left behind is taken over.
/// [set-up] constructor; [estimate thread] publish(): real-time safe, one system call (futex) that wakes
/// whoever waits; [any thread] newest().
class PoseBoard {
 public:
  /// `name` as in /dev/shm/NAME; empty: memory of this process alone. Throws Error if the name is not valid
  /// or another running process publishes there.
  explicit PoseBoard(const std::string& name);
  ~PoseBoard();

  void publish(PoseV1 pose) noexcept;

  /// False while there is none.
  bool newest(PoseKind kind, PoseV1& pose) const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago::output
