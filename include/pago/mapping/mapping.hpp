// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/stage.hpp"
#include "pago/mapping/joint_registration.hpp"

namespace pago::mapping {

/// Scan-to-map as a pipeline stage.
class MappingStage {
 public:
  explicit MappingStage(const MappingConfig& config);

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept;

  const RefinedState& refined() const noexcept { return refined_; }

 private:
  void load(const Sweep& sweep) noexcept;
  void insert(const Vector6d& twist) noexcept;
  void report(Sweep& sweep) noexcept;

  MappingConfig config_;
  registration::CellMap map_;
  JointRegistration registration_;
  registration::PointCloud key_points_, map_points_;

  bool started_ = false, is_placed_ = false;
  std::int64_t first_reference_ns_ = 0, first_reported_ns_ = 0;
  Vector6d twist_ = Vector6d::Zero();       // mean over the last period
  Vector6d at_reference_ = Vector6d::Zero();  // at the last reference instant
  RefinedState refined_;
  Eigen::Isometry3d T_odom_map_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_reference_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::mapping
