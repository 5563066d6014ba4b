// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/core/stage.hpp"
#include "pago/odometry/loam_registration.hpp"
#include "pago/odometry/registration.hpp"

namespace pago::odometry {

/// Scan-to-scan odometry as a pipeline stage: the first poses, and the front end's. One of each per sweep
/// that gets one; where a sweep cannot be registered the motion is carried on at constant velocity and the
/// health says why. Mapping refines pose and health (and overwrites the latter).
///
/// Poses are chained between the sweeps' reference instants (their middles) and reported at the configured
/// one. The first posed sweep defines `odom`: its pose at the reported instant is the identity.
///
/// How the sensor moves at the start is found out by mapping, as that takes several sweeps; until then first
/// and front-end poses follow mapping's.
///
/// finish() registers; update(), called once the poses are out, prepares the next sweep's targets.
/// [set-up] constructor; [estimate thread] the rest: real-time safe, deterministic. About 3 ms of CPU per
/// sweep. With registration = loam it allocates.
class OdometryStage {
 public:
  /// `refined` is read with each sweep and must outlive the stage.
  OdometryStage(const OdometryConfig& config, std::uint32_t max_returns, const RefinedState& refined);

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept;
  void update(Sweep& sweep) noexcept;

  /// As if no sweep had come yet: the next one defines `odom` anew.
  void reset() noexcept;

 private:
  ScanMotion instants_of(const SweepHeader& header) const noexcept;
  void time_since_last(const SweepHeader& header, ScanMotion& motion) const noexcept;
  void follow_start(ScanMotion& motion) noexcept;
  void advance(Sweep& sweep) noexcept;
  bool has_slipped() const noexcept;
  bool knows_of_map() const noexcept;
  Eigen::Isometry3d first_motion(const ScanMotion& motion) const noexcept;
  bool agrees_with_map(const RegistrationResult& result, double period_s) const noexcept;
  RegistrationResult align(const ScanMotion& motion, const Eigen::Isometry3d& T_predicted) noexcept;
  HealthReason judge(const RegistrationResult& result, const Eigen::Isometry3d& T_predicted) const noexcept;
  void state(Estimate& estimate,
             const RegistrationResult& result,
             HealthReason reason,
             double period_s) noexcept;
  void report(Sweep& sweep) noexcept;

  OdometryConfig config_;
  const RefinedState& refined_;
  TwoStepRegistration registration_;
  std::unique_ptr<LoamRegistration> loam_;  // instead, where asked for
  FeatureSet sources_, raw_targets_;
  Targets targets_;

  bool has_last_ = false, has_motion_ = false;
  ScanMotion last_;
  Vector6d twist_ = Vector6d::Zero();  // per second, between the last two reference instants
  Eigen::Isometry3d T_odom_reference_ = Eigen::Isometry3d::Identity();
  int predicted_in_a_row_ = 0;
};

}  // namespace pago::odometry
