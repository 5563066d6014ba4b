// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/mapping.hpp"

#include <algorithm>
#include <cmath>

#include "local_map.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/core/units.hpp"
#include "pago/registration/motion_model.hpp"

namespace pago::mapping {

using registration::PointCloud;

namespace {

/// The table is gone through once in so many sweeps, to find cells that are too far away.
constexpr std::uint32_t kPruningRound_sweeps = 16;
/// A sensor that stands sees the same again: so many sweeps of it fill the cells.
constexpr int kMostInsertedStanding = 5;
/// Longer since the last sweep than this: the motion in between is not what it was.
constexpr double kGap_s = 0.35;

void load_points(const Sweep& sweep,
                 const FixedVector<std::uint32_t>& list,
                 const LaserOffsets& lasers,
                 PointCloud& out) noexcept {
  const std::int64_t reference_ns = sweep.motion.reference_ns - sweep.header.start_ns;
  out.size = 0;
  for (const std::uint32_t i : list) {
    const float before_s = sweep.motion.is_compensated
                               ? 0.0F
                               : static_cast<float>(reference_ns - sweep.time_offset_ns[i]) * 1e-9F;
    const Eigen::Vector3f p(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    out.add(lasers.corrected(p, sweep.ring[i]), before_s, sweep.ground[i]);
  }
}

/// Whether a position is known to worse than half a centimetre in some direction, were errors independent.
bool is_vague(const JointResult& result) noexcept {
  constexpr double kVague_m = 0.005;
  const Matrix6d information = result.information + 1e-6 * Matrix6d::Identity();
  return inverse_of(information).diagonal().head<3>().maxCoeff() > kVague_m * kVague_m;
}

}  // namespace

MappingStage::MappingStage(const MappingConfig& config)
    : config_(config),
      map_(options_of(config.cells), static_cast<std::uint32_t>(config.cells.max_cells)),
      registration_(config, kMaxMapPoints),
      start_(config),
      trust_(config),
      keyframes_(config.keyframes),
      lasers_(config.lasers),
      key_points_(kMaxKeyPoints),
      map_points_(kMaxMapPoints),
      dense_(kMaxDensePoints),
      rings_(kMaxKeyPoints) {}

void MappingStage::finish(Sweep& sweep) noexcept {
  is_inserted_ = false;
  if (!sweep.header.is_posed()) return;
  load(sweep);
  if (phase_ == Phase::kSearching && sweep.motion.period_s > kGap_s) phase_ = Phase::kEmpty;
  switch (phase_) {
    case Phase::kEmpty:
      start(sweep);
      break;
    case Phase::kSearching:
      search(sweep.motion, sweep.estimate);
      break;
    case Phase::kTracking:
      track(sweep.motion, sweep);
      break;
  }
  report(sweep.motion, sweep.estimate);
}

void MappingStage::reset() noexcept {
  map_.clear();
  trust_.restart();
  standstill_.reset();
  keyframes_.reset();
  lasers_.reset();
  phase_ = Phase::kEmpty;
  refined_ = {};
  T_odom_map_.setIdentity();
  T_map_reference_.setIdentity();
  refined_.twist.setZero();
  forget_changes();
  mean_sq_acceleration_.setZero();
  is_placed_ = is_elsewhere_ = false;
  unmeasured_s_ = 0.0;
  predicted_in_a_row_ = unconfirmed_ = inserted_standing_ = 0;
}

void MappingStage::update(Sweep& sweep) noexcept {
  if (!is_inserted_) return;
  if (sweep.estimate.health == Health::kOk) {
    std::size_t i = 0;
    for (const std::uint32_t point : sweep.features.key_points) rings_[i++] = sweep.ring[point];
    lasers_.learn(map_, key_points_, rings_.first(i), T_map_reference_, within_);
  }
  insert_points(map_points_, within_, T_map_reference_, map_);
  map_.prune(T_map_reference_.translation(), config_.cells.radius_m, map_.num_slots() / kPruningRound_sweeps);
}

void MappingStage::load(const Sweep& sweep) noexcept {
  load_points(sweep, sweep.features.key_points, lasers_, key_points_);
  load_points(sweep, sweep.features.map_points, lasers_, map_points_);
  if (phase_ != Phase::kTracking) load_points(sweep, sweep.features.dense, lasers_, dense_);
}

void MappingStage::start(Sweep& sweep) noexcept {
  const ScanMotion& motion = sweep.motion;
  Estimate& estimate = sweep.estimate;
  if (!refined_.is_placed) first_reference_ns_ = motion.reference_ns, first_reported_ns_ = motion.reported_ns;
  start_.begin({dense_, map_points_, key_points_}, motion.is_compensated);
  T_map_start_ = T_map_reference_;
  phase_ = Phase::kSearching;
  since_searched_s_ = unmeasured_s_ = 0.0;
  refined_.twist.setZero();
  forget_changes();
  estimate.health = refined_.is_placed ? Health::kLost : Health::kInit;
  estimate.reason = refined_.is_placed ? HealthReason::kMapRestarted : HealthReason::kFirstSweep;
  estimate.covariance = inverse_of(registration::predicted_information(1.0, 0));
  if (config_.start.search) return;
  insert_points(map_points_, {refined_.twist}, T_map_reference_, map_);
  phase_ = Phase::kTracking;
  refined_.has_motion = true;
}

void MappingStage::search(const ScanMotion& motion, Estimate& estimate) noexcept {
  estimate.health = Health::kInit;
  since_searched_s_ += motion.period_s;
  if (static_cast<int>(key_points_.size) < config_.trust.min_matches) {
    T_map_reference_ = T_map_reference_ * exp_se3(refined_.twist * motion.period_s);
    estimate.reason = HealthReason::kTooFewFeatures;
    return;
  }
  start_.add({dense_, map_points_, key_points_}, since_searched_s_);
  const JointResult& result = start_.result();
  const Eigen::Isometry3d T_map_measured = T_map_start_ * start_.T_start_last();
  move_to(standstill_.update(T_map_measured, result.T_last_this, result.information), since_searched_s_);
  since_searched_s_ = 0.0;
  MotionGuess guess;
  guess.period_s = motion.period_s;
  state(motion, guess, result, HealthReason::kNone, estimate);
  if (!start_.is_decided()) {
    estimate.health = Health::kInit;
    estimate.reason = HealthReason::kMotionUnknown;
    return;
  }
  start_.settle();
  start_.hand_over(T_map_start_, map_);
  trust_.accept(result);
  phase_ = Phase::kTracking;
  refined_.has_motion = true;
}

namespace {

/// Sweeps that may fail to fit the map after so long a gap that the vehicle may be out of the map's sight.
constexpr int kPatienceElsewhere = 2;

bool is_unknown(const ScanMotion& motion) noexcept {
  return motion.is_time_lost || motion.period_s > registration::kLongestPrediction_s;
}

}  // namespace

void MappingStage::track(const ScanMotion& motion, Sweep& sweep) noexcept {
  const MotionGuess guess = guess_of(motion);
  if (!config_.refine) {
    JointResult odometry;
    odometry.T_last_this = guess.T_last_this;
    adopt(motion, guess, odometry, false);
    is_inserted_ = false;
    return;
  }
  JointResult result = registration_.align(map_, key_points_, guess, trust_.limits(), *budget_);
  if (is_vague(result) && !result.is_cut) result = look_closer(guess, result);
  HealthReason reason = trust_.judge(result, guess.T_last_this, refined_.twist, motion.period_s);
  // After a gap even a good fit may be to the wrong place.
  const bool is_gap = motion.is_time_lost || motion.period_s > kGap_s;
  const bool is_astray =
      trust_.failures() % config_.trust.relocalise_after == config_.trust.relocalise_after - 1;
  if (is_gap || (!is_measured(reason) && is_astray)) {
    const JointResult found = relocalise(guess);
    if (trust_.is_usual(found.score) && static_cast<int>(found.matches) >= config_.trust.min_matches) {
      result = found;
      reason = found.doubted.count > 0 ? HealthReason::kNotObservable : HealthReason::kNone;
    }
  }
  is_elsewhere_ = !is_measured(reason) && (is_elsewhere_ || is_unknown(motion));
  adopt(motion, guess, result, is_measured(reason));
  state(motion, guess, result, reason, sweep.estimate);
  const int patience = is_elsewhere_ ? kPatienceElsewhere : config_.trust.restart_after;
  if (trust_.failures() >= patience) restart(!guess.is_carried, sweep.estimate);
  if (sweep.header.has(kIncomplete) && sweep.estimate.reason == HealthReason::kNone) {
    sweep.estimate.health = Health::kDegraded;
    sweep.estimate.reason = HealthReason::kIncompleteSweep;
  }
}

// Two opinions on the motion since the last sweep, each by its own information: what scan-to-scan has found,
// and that it has not changed much. On a bare highway either alone is off by decimetres.
MotionGuess MappingStage::guess_of(const ScanMotion& motion) const noexcept {
  MotionGuess guess;
  guess.T_map_last = T_map_reference_;
  guess.period_s = motion.is_compensated ? 0.0 : motion.period_s;
  guess.T_last_this = exp_se3(refined_.twist * std::min(motion.period_s, registration::kLongestPrediction_s));
  guess.is_carried = true;
  if (motion.period_s > kGap_s || motion.is_time_lost) return guess;
  if (unmeasured_s_ > 0.0)
    guess.twist = refined_.twist;
  else
    guess.acceleration = acceleration_;
  guess.acceleration_sigma = unsteadiness();
  guess.information = registration::predicted_information(motion.period_s, unconfirmed_);
  const bool is_credible = !config_.refine || registration::may_follow(motion.T_last_this, refined_.twist,
                                                                       motion.period_s, unconfirmed_);
  if (!motion.is_registered || !is_credible) return guess;
  guess.is_carried = false;
  const Matrix6d told = config_.prior_weight * motion.information;
  guess.T_last_this =
      config_.refine ? registration::fused(motion.T_last_this, told, guess.T_last_this, guess.information)
                     : motion.T_last_this;
  guess.information += told;
  return guess;
}

// How far the acceleration of a sweep may be off: on a smooth road less than where the springs are at work.
Vector6d MappingStage::unsteadiness() const noexcept {
  constexpr double kOfLately = 1.5;
  Vector6d least;
  least.head<3>().setConstant(config_.acceleration_sigma_m_s2);
  least.tail<3>().setConstant(config_.acceleration_sigma_rad_s2);
  return least.cwiseMax(kOfLately * mean_sq_acceleration_.cwiseSqrt());
}

void MappingStage::adopt(const ScanMotion& motion,
                         const MotionGuess& guess,
                         const JointResult& result,
                         bool usable) noexcept {
  const Eigen::Isometry3d T_last_this = usable ? result.T_last_this : guess.T_last_this;
  Eigen::Isometry3d T_map_this = T_map_reference_ * T_last_this;
  if (usable && result.weak.count == 0) {
    T_map_this = standstill_.update(T_map_this, T_last_this, result.information);
  } else {
    standstill_.reset();
  }
  const bool is_told = usable || !guess.is_carried, was_guessed = unmeasured_s_ > 0.0;
  if (!usable && !was_guessed) T_map_measured_ = T_map_reference_;
  unmeasured_s_ += motion.period_s;
  if (usable && was_guessed) {  // the way from a guess would be no velocity
    T_map_reference_ = T_map_measured_;
    move_to(T_map_this, unmeasured_s_);
  } else if (usable && !motion.is_compensated)
    move_to(T_map_this, motion.period_s, result.within);
  else if (is_told)
    move_to(T_map_this, motion.period_s);
  else
    T_map_reference_ = orthonormalized(T_map_this), forget_changes();
  if (usable) {
    unmeasured_s_ = 0.0;
    trust_.accept(result);
  } else {
    trust_.reject();
  }
  predicted_in_a_row_ = is_told ? 0 : predicted_in_a_row_ + 1;
  unconfirmed_ = usable && result.weak.count == 0 ? 0 : unconfirmed_ + 1;
  inserted_standing_ = standstill_.is_standing() ? inserted_standing_ + 1 : 0;
  is_inserted_ = usable && inserted_standing_ <= kMostInsertedStanding;
}

// What is known of the velocity at the reference instant is handed on so that it holds where it is needed:
// half way to the end of the sweep. The acceleration is that of the last few sweeps.
void MappingStage::move_to(const Eigen::Isometry3d& T_map_this,
                           double period_s,
                           const std::optional<MotionInSweep>& within) noexcept {
  constexpr double kSmoothing = 0.7, kHalfToEnd = 0.25, kMemory_sweeps = 20.0;
  const Vector6d since_last = log_se3(T_map_reference_.inverse() * T_map_this) / period_s;
  if (phase_ == Phase::kTracking) {
    const Vector6d change = (since_last - refined_.twist) / period_s;
    acceleration_ += kSmoothing * (change - acceleration_);
    mean_sq_acceleration_ += (change.cwiseAbs2() - mean_sq_acceleration_) / kMemory_sweeps;
  }
  refined_.twist = since_last;
  refined_.period_s = std::min(period_s, kGap_s);
  const MotionInSweep expected{refined_.twist + 0.5 * refined_.period_s * acceleration_, acceleration_};
  within_ = within.value_or(expected);
  const double ahead_s = kHalfToEnd * refined_.period_s;
  refined_.acceleration =
      (within_.twist + ahead_s * acceleration_ - refined_.twist) / (0.5 * refined_.period_s + ahead_s);
  if (standstill_.is_still()) refined_.twist.setZero(), forget_changes();
  T_map_reference_ = orthonormalized(T_map_this);
}

void MappingStage::forget_changes() noexcept {
  acceleration_.setZero(), refined_.acceleration.setZero();
  within_ = {refined_.twist};
}

// Nothing of the old map fits any more. Where scan-to-scan still tells the motion, the new one goes on from
// here; else it begins as at the very start.
void MappingStage::restart(bool is_told, Estimate& estimate) noexcept {
  map_.clear();
  trust_.restart();
  standstill_.reset();
  is_elsewhere_ = false;
  unmeasured_s_ = 0.0;
  estimate.health = Health::kLost;
  estimate.reason = HealthReason::kMapRestarted;
  is_inserted_ = is_told;
  if (!is_told) {
    phase_ = Phase::kEmpty;
    refined_.has_motion = false;
  }
}

void MappingStage::state(const ScanMotion& motion,
                         const MotionGuess& guess,
                         const JointResult& result,
                         HealthReason reason,
                         Estimate& estimate) const noexcept {
  estimate.iterations = static_cast<std::uint16_t>(result.iterations);
  estimate.is_cut_short = result.is_cut;
  estimate.weak_directions = result.doubted.axes;
  estimate.map_points = result.offered;
  estimate.map_matches = result.matches;
  estimate.map_rms_m = static_cast<float>(result.rms_m);
  estimate.map_score = static_cast<float>(result.score);

  const bool has_opinion = !guess.information.isZero();
  Matrix6d information =
      has_opinion ? guess.information : registration::predicted_information(motion.period_s, unconfirmed_);
  if (is_measured(reason)) information += result.doubted.without(result.information);
  estimate.covariance = inverse_of(information);

  if (reason == HealthReason::kNone && is_unknown(motion)) reason = HealthReason::kTimeGap;
  if (reason == HealthReason::kNone && result.is_cut) reason = HealthReason::kCutShort;
  estimate.reason = reason;
  estimate.health = reason == HealthReason::kNone ? Health::kOk : Health::kDegraded;
  if (predicted_in_a_row_ >= config_.trust.lost_after) estimate.health = Health::kLost;
}

void MappingStage::report(const ScanMotion& motion, Estimate& estimate) noexcept {
  // The very first pose was reported as the identity. Where that lies in the map is known once it is known
  // how the sensor moved then.
  if (!is_placed_) {
    const double reported_s = seconds(first_reported_ns_ - first_reference_ns_);
    const Vector6d first_twist = standstill_.is_still() ? Vector6d::Zero() : start_.first_twist();
    T_odom_map_ = (start_.T_start_first() * exp_se3(reported_s * first_twist)).inverse();
    is_placed_ = refined_.has_motion && phase_ == Phase::kTracking;
  }
  refined_.is_placed = true;
  refined_.is_of_map = config_.refine;
  refined_.T_odom_reference = T_odom_map_ * T_map_reference_;
  const bool belongs_to_map = is_inserted_ || (phase_ == Phase::kTracking && !config_.refine);
  estimate.is_keyframe = belongs_to_map && keyframes_.take(refined_.T_odom_reference);
  const double reported_s = seconds(motion.reported_ns - motion.reference_ns);
  estimate.twist = within_.twist_at(reported_s);
  estimate.T_odom_sensor_refined = refined_.T_odom_reference * within_.pose_at(reported_s);
}

}  // namespace pago::mapping
