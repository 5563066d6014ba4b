// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/stage.hpp"
#include "pago/odometry/registration.hpp"

namespace pago::odometry {

/// Scan-to-scan odometry as a pipeline stage: writes sweep.estimate. One pose per sweep that gets one; where
/// a sweep cannot be registered the motion is carried on at constant velocity and the health says why.
///
/// Poses are chained between the sweeps' reference instants (their ends; the middle for compensated sweeps)
/// and reported at the configured one. The first posed sweep defines `odom`: its pose at the reported instant
/// is the identity. [set-up] constructor; [estimate thread] the rest: real-time safe, deterministic.
/// A sweep takes about 10 ms of CPU; the one at which a first motion is sought from several guesses about 0.3
/// s.
class OdometryStage {
 public:
  OdometryStage(const OdometryConfig& config, std::uint32_t max_returns);

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept;

  /// As if no sweep had come yet: the next one defines `odom` anew.
  void reset() noexcept;

 private:
  struct Instants {
    std::int64_t reference_ns = 0;  // poses are chained between these
    std::int64_t reported_ns = 0;
    bool compensated = false;
  };

  Instants instants_of(const SweepHeader& header) const noexcept;
  void load_sources(const Sweep& sweep, const Instants& instants) noexcept;
  void load_targets(const Sweep& sweep, const Instants& instants) noexcept;
  void build_targets(const Vector6d& twist) noexcept;
  void start(Sweep& sweep, const Instants& instants) noexcept;
  void advance(Sweep& sweep, const Instants& instants) noexcept;
  RegistrationResult find_first_motion(double period_s) noexcept;
  HealthReason judge(const RegistrationResult& result, const Eigen::Isometry3d& T_predicted) const noexcept;
  void adopt(Estimate& estimate,
             const RegistrationResult& result,
             HealthReason reason,
             double period_s) noexcept;
  void report(Sweep& sweep, const Instants& instants) noexcept;

  OdometryConfig config_;
  TwoStepRegistration registration_;
  FeatureSet sources_, few_sources_, raw_targets_;
  FeatureCloud deskewed_;
  TargetSet targets_;

  bool started_ = false, is_placed_ = false, has_motion_ = false;
  bool targets_compensated_ = false;
  Instants last_;
  Vector6d twist_ = Vector6d::Zero();  // per second, of the reference frame
  Eigen::Isometry3d T_odom_reference_ = Eigen::Isometry3d::Identity();
  int predicted_in_a_row_ = 0;
};

}  // namespace pago::odometry
