// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/config/mapping.hpp"
#include "pago/core/stage.hpp"
#include "pago/mapping/keyframes.hpp"

namespace pago::mapping {

/// Scan-to-map of LeGO-LOAM and PaGO-LOAM (mapOptmization and transformFusion, without loop closing) as a
/// pipeline stage: method = keyframes, for the paper presets and studies. Every few sweeps edges and planar
/// points are registered to those of the keyframes within a radius; in between, and where that fails, the
/// pose is the last registered one carried on by odometry. Their nodes run beside each other and drop what
/// comes too fast; here each sweep waits for the map, so a run is deterministic.
///
/// Not for the hot path: allocates, takes some 100 ms for a registered sweep, and keeps every keyframe (about
/// 50 kB). The vehicle is taken to stand at the start. [set-up] constructor; [estimate thread] the rest.
class KeyframeMapping {
 public:
  explicit KeyframeMapping(const MappingConfig& config);
  ~KeyframeMapping();

  void finish(Sweep& sweep) noexcept;
  void reset() noexcept;
  const RefinedState& refined() const noexcept { return refined_; }

 private:
  struct Parts;

  bool is_due(const ScanMotion& motion) noexcept;
  void register_to_map(Sweep& sweep) noexcept;
  void report(const ScanMotion& motion, Estimate& estimate) noexcept;

  MappingConfig config_;
  std::unique_ptr<Parts> parts_;
  Keyframes saved_;
  RefinedState refined_;
  Eigen::Isometry3d T_odometry_ = Eigen::Isometry3d::Identity();    // product of odometry's motions
  Eigen::Isometry3d T_correction_ = Eigen::Isometry3d::Identity();  // from those to the map: after before^-1
  Eigen::Isometry3d T_map_reference_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d last_registered_at_ = Eigen::Vector3d::Zero();
  std::uint64_t sweeps_ = 0;
  std::int64_t last_registered_ns_ = 0;
};

}  // namespace pago::mapping
