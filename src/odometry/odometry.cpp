// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/odometry.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/core/units.hpp"
#include "pago/registration/motion_model.hpp"

namespace pago::odometry {

namespace {

constexpr std::size_t kMaxSources = kNumRings * 6 * 20;
constexpr double kNominalSweep_s = 0.1;
/// Longer without a sweep: the sensor's clock began anew, more likely than not.
constexpr double kLongestGap_s = 10.0;

void add_to(PointCloud& cloud, const Sweep& sweep, std::uint32_t i) noexcept {
  cloud.add({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, sweep.before_reference_s(i), sweep.ring[i]);
}

void load(FeatureSet& set,
          const Sweep& sweep,
          const FixedVector<std::uint32_t>& edges,
          const FixedVector<std::uint32_t>& planars) noexcept {
  set.edges.size = set.ground.size = set.walls.size = 0;
  for (const std::uint32_t i : edges) add_to(set.edges, sweep, i);
  for (const std::uint32_t i : planars) add_to(sweep.ground[i] == kGround ? set.ground : set.walls, sweep, i);
}

}  // namespace

OdometryStage::OdometryStage(const OdometryConfig& config,
                             std::uint32_t max_returns,
                             const RefinedState& refined)
    : config_(config),
      refined_(refined),
      registration_(config, kMaxSources),
      sources_(kMaxSources),
      raw_targets_(max_returns),
      targets_(config, max_returns) {
  if (config.registration == Registration::kLoam) loam_ = std::make_unique<LoamRegistration>(config);
}

void OdometryStage::reset() noexcept {
  has_last_ = has_motion_ = false;
  twist_.setZero();
  T_odom_reference_.setIdentity();
  predicted_in_a_row_ = 0;
}

void OdometryStage::finish(Sweep& sweep) noexcept {
  if (!sweep.header.is_posed()) return;
  sweep.motion = instants_of(sweep.header);
  if (has_last_) time_since_last(sweep.header, sweep.motion);
  load(sources_, sweep, sweep.features.sharp_edges, sweep.features.flat_planars);
  if (has_motion_) {
    advance(sweep);
  } else {
    follow_start(sweep.motion);
    sweep.estimate.health = Health::kInit;
    sweep.estimate.reason = has_last_ ? HealthReason::kMotionUnknown : HealthReason::kFirstSweep;
    sweep.estimate.covariance = inverse_of(registration::predicted_information(1.0, 0));
  }
  report(sweep);
}

void OdometryStage::update(Sweep& sweep) noexcept {
  if (!sweep.header.is_posed()) return;
  if (!has_motion_) {
    T_odom_reference_ = refined_.T_odom_reference;
    twist_ = refined_.twist;
    has_motion_ = refined_.has_motion;
  }
  const Vector6d twist = sweep.motion.is_compensated || !config_.deskew ? Vector6d::Zero() : twist_;
  if (loam_) {
    loam_->set_targets(sweep, twist);
  } else {
    load(raw_targets_, sweep, sweep.features.edges, sweep.features.planars);
    targets_.build(raw_targets_, twist);
  }
  last_ = sweep.motion;
  has_last_ = true;
}

// Poses are chained between the middles of sweeps: an error of the velocity moves the returns of a sweep's
// two halves to opposite sides and cancels. Between ends it would move all to one side, and the chain of ever
// new de-skewed targets hands such an error on, with alternating sign, undamped.
ScanMotion OdometryStage::instants_of(const SweepHeader& header) const noexcept {
  ScanMotion motion;
  motion.reference_ns = motion.reported_ns = header.start_ns + (header.end_ns - header.start_ns) / 2;
  motion.is_compensated = header.has(kCompensated);
  if (motion.is_compensated) return motion;
  if (config_.pose_instant == PoseInstant::kStart) motion.reported_ns = header.start_ns;
  if (config_.pose_instant == PoseInstant::kEnd) motion.reported_ns = header.end_ns;
  return motion;
}

void OdometryStage::time_since_last(const SweepHeader& header, ScanMotion& motion) const noexcept {
  motion.period_s = seconds(motion.reference_ns - last_.reference_ns);
  motion.is_time_lost = motion.period_s <= 0.0 || motion.period_s > kLongestGap_s;
  if (!motion.is_time_lost) return;
  motion.period_s = seconds(header.end_ns - header.start_ns);
  if (motion.period_s <= 0.0) motion.period_s = kNominalSweep_s;
}

void OdometryStage::follow_start(ScanMotion& motion) noexcept {
  motion.T_last_this = exp_se3(refined_.twist * motion.period_s);
  T_odom_reference_ = refined_.T_odom_reference * motion.T_last_this;
  twist_ = refined_.twist;
}

void OdometryStage::advance(Sweep& sweep) noexcept {
  ScanMotion& motion = sweep.motion;
  const double carried_s = std::min(motion.period_s, registration::kLongestPrediction_s);
  if (has_slipped()) twist_ = refined_.twist;
  const Eigen::Isometry3d T_predicted = exp_se3(twist_ * carried_s);
  const RegistrationResult result = align(motion, T_predicted);
  HealthReason reason = judge(result, T_predicted);
  if (is_measured(reason) && !agrees_with_map(result, motion.period_s))
    reason = HealthReason::kImplausibleMotion;

  motion.is_registered = is_measured(reason);
  motion.T_last_this = motion.is_registered ? result.T_target_source : T_predicted;
  if (motion.is_registered) {
    motion.information = result.information;
    twist_ = log_se3(motion.T_last_this) / motion.period_s;
  }
  T_odom_reference_ = orthonormalized(T_odom_reference_ * motion.T_last_this);
  state(sweep.estimate, result, motion.is_time_lost ? HealthReason::kTimeGap : reason, motion.period_s);
  if (sweep.header.has(kIncomplete) && sweep.estimate.reason == HealthReason::kNone) {
    sweep.estimate.health = Health::kDegraded;
    sweep.estimate.reason = HealthReason::kIncompleteSweep;
  }
}

// Where there are grass and hedges only, the last sweep's scan lines are what fits best: no motion. The map,
// made of many sweeps, knows better. PaGO-LOAM's front end does not ask its map, whose poses leap when a
// sweep is registered.
bool OdometryStage::has_slipped() const noexcept {
  if (loam_ || !refined_.has_motion || refined_.period_s <= 0.0) return false;
  const Eigen::Isometry3d T_own = exp_se3(twist_ * refined_.period_s);
  return predicted_in_a_row_ > 0 || !registration::may_follow(T_own, refined_.twist, refined_.period_s, 0);
}

bool OdometryStage::knows_of_map() const noexcept {
  return !loam_ && refined_.is_of_map && refined_.has_motion && refined_.period_s > 0.0;
}

// And a motion that no vehicle has after the one before is that of what has driven by.
bool OdometryStage::agrees_with_map(const RegistrationResult& result, double period_s) const noexcept {
  if (!knows_of_map()) return true;
  return registration::may_follow(result.T_target_source, refined_.twist, period_s, predicted_in_a_row_);
}

RegistrationResult OdometryStage::align(const ScanMotion& motion,
                                        const Eigen::Isometry3d& T_predicted) noexcept {
  const double period_s = motion.is_compensated ? 0.0 : motion.period_s;
  if (loam_) return loam_->align(sources_, T_predicted, period_s);
  return registration_.align(sources_, targets_, T_predicted, period_s);
}

HealthReason OdometryStage::judge(const RegistrationResult& result,
                                  const Eigen::Isometry3d& T_predicted) const noexcept {
  if (!result.T_target_source.matrix().allFinite() || !result.information.allFinite())
    return HealthReason::kNotFinite;
  if (static_cast<int>(result.ground_matches) < config_.min_planar_matches ||
      static_cast<int>(result.edge_matches + result.wall_matches) < config_.min_edge_matches) {
    return HealthReason::kTooFewFeatures;
  }
  const Vector6d correction = difference(T_predicted, result.T_target_source);
  if (correction.head<3>().norm() > config_.max_correction_m ||
      correction.tail<3>().norm() > config_.max_correction_deg * kDegree) {
    return HealthReason::kImplausibleMotion;
  }
  return result.weak.count > 0 ? HealthReason::kNotObservable : HealthReason::kNone;
}

void OdometryStage::state(Estimate& estimate,
                          const RegistrationResult& result,
                          HealthReason reason,
                          double period_s) noexcept {
  predicted_in_a_row_ = is_measured(reason) ? 0 : predicted_in_a_row_ + 1;
  estimate.reason = reason;
  estimate.health = reason == HealthReason::kNone ? Health::kOk : Health::kDegraded;
  if (predicted_in_a_row_ >= config_.lost_after) estimate.health = Health::kLost;
  Matrix6d information = registration::predicted_information(period_s, predicted_in_a_row_);
  if (is_measured(reason)) information += result.information;
  estimate.covariance = inverse_of(information);
  estimate.rounds = static_cast<std::uint16_t>(result.rounds);
  estimate.edge_matches = result.edge_matches;
  estimate.planar_matches = result.ground_matches + result.wall_matches;
  estimate.edge_rms_m = static_cast<float>(result.edge_rms_m);
  estimate.planar_rms_m = static_cast<float>(result.ground_rms_m);
}

// Two opinions on the motion, as in mapping: what this sweep says, and that it has not changed much.
Eigen::Isometry3d OdometryStage::first_motion(const ScanMotion& motion) const noexcept {
  constexpr double kTrust = 0.3;  // errors of matches are not independent
  if (!motion.is_registered || !knows_of_map()) return motion.T_last_this;
  return registration::fused(motion.T_last_this, kTrust * motion.information,
                             exp_se3(refined_.twist * motion.period_s),
                             registration::predicted_information(motion.period_s, 0));
}

void OdometryStage::report(Sweep& sweep) noexcept {
  Estimate& estimate = sweep.estimate;
  estimate.has_pose = true;
  estimate.stamp_ns = sweep.motion.reported_ns;
  // What the twist is at other instants than between the middles of sweeps, mapping knows best.
  RefinedState carried = refined_;
  carried.twist = twist_, carried.period_s = sweep.motion.period_s;
  const double reported_s = seconds(sweep.motion.reported_ns - sweep.motion.reference_ns);
  estimate.twist = carried.twist_at(reported_s);
  const Eigen::Isometry3d T_reference_reported = exp_se3(reported_s * carried.twist_at(0.5 * reported_s));
  estimate.T_odom_sensor_front_end = T_odom_reference_ * T_reference_reported;
  estimate.T_odom_sensor_first =
      refined_.T_odom_reference * first_motion(sweep.motion) * T_reference_reported;
  estimate.T_odom_sensor_refined = estimate.T_odom_sensor_first;
}

}  // namespace pago::odometry
