// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <string_view>

#include "pago/core/se3.hpp"
#include "pago/output/pose_board.hpp"

namespace pago::output {

namespace {

void set_name(char (&field)[16], std::string_view name) noexcept {
  std::memset(field, 0, sizeof field);
  name.copy(field, sizeof field - 1);
}

}  // namespace

PoseMaker::PoseMaker(PoseChild child, const Mount& mount) : child_(child) {
  if (child == PoseChild::kBaseLink) T_child_sensor_ = mount.T_base_sensor();
  adjoint_ = adjoint(T_child_sensor_);
}

Eigen::Isometry3d PoseMaker::child_pose(const Eigen::Isometry3d& T_odom_sensor) const noexcept {
  return T_child_sensor_ * T_odom_sensor * T_child_sensor_.inverse();
}

PoseV1 PoseMaker::make(const Sweep& sweep, PoseKind kind) const noexcept {
  const Estimate& estimate = sweep.estimate;
  const bool is_first = kind == PoseKind::kFirst;
  const Eigen::Isometry3d T =
      child_pose(is_first ? estimate.T_odom_sensor_first : estimate.T_odom_sensor_refined);
  const Eigen::Quaterniond q(T.linear());
  PoseV1 pose{};
  pose.magic = PAGO_POSE_V1;
  pose.kind = static_cast<std::uint8_t>(kind);
  pose.health = static_cast<std::uint8_t>(estimate.health);
  pose.reason = static_cast<std::uint8_t>(estimate.reason);
  pose.sequence = sweep.header.sequence;
  pose.stamp_ns = estimate.stamp_ns + sweep.header.clock_offset_ns;
  pose.last_arrival_ns = sweep.header.last_arrival_ns;
  set_name(pose.frame_id, "odom");
  set_name(pose.child_frame_id, child_ == PoseChild::kBaseLink ? "base_link" : "sensor");
  Eigen::Map<Eigen::Vector3d>(pose.position_m) = T.translation();
  Eigen::Map<Eigen::Vector4d>(pose.orientation_xyzw) = q.coeffs();
  Eigen::Map<Vector6d>(pose.twist) = adjoint_ * estimate.twist;
  Eigen::Map<Matrix6d>(pose.covariance) = adjoint_ * estimate.covariance * adjoint_.transpose();  // symmetric
  return pose;
}

}  // namespace pago::output
