// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/odometry.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"

namespace pago::odometry {

namespace {

/// Deviation of a vehicle's motion over one sweep that nothing measured: added information where matches give
/// none.
constexpr double kPrior_m = 0.5, kPrior_rad = 0.05;
/// Makes rotations comparable with translations: what a turn moves at this distance.
constexpr double kLeverArm_m = 10.0;
constexpr double kNominalSweep_s = 0.1;

/// Of the features, enough to tell a right first motion from a wrong one.
constexpr std::size_t kOneOf = 4;

/// A motion is carried on for no longer than this: nothing says that the vehicle did not stop.
constexpr double kLongestPrediction_s = 2.0, kLongestGap_s = 10.0;

constexpr double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

Matrix6d prior_information() {
  Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(1.0 / (kPrior_m * kPrior_m)),
      Eigen::Vector3d::Constant(1.0 / (kPrior_rad * kPrior_rad));
  return diagonal.asDiagonal();
}

/// Information of the weakest direction of motion over that of the strongest.
double observability(const Matrix6d& information) {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1.0 / kLeverArm_m);
  const Matrix6d comparable = scale.asDiagonal() * information * scale.asDiagonal();
  const Vector6d values = eigen_of(comparable).values;
  return values[0] / std::max(values[5], 1e-12);
}

}  // namespace

OdometryStage::OdometryStage(const OdometryConfig& config, std::uint32_t max_returns)
    : config_(config),
      registration_(config, kNumRings * 6 * 20),
      sources_(kNumRings * 6 * 20),
      few_sources_(kNumRings * 6 * 20 / kOneOf + 1),
      raw_targets_(max_returns),
      deskewed_(max_returns),
      targets_(max_returns) {}

void OdometryStage::reset() noexcept {
  started_ = is_placed_ = has_motion_ = false;
  twist_.setZero();
  T_odom_reference_.setIdentity();
  predicted_in_a_row_ = 0;
}

void OdometryStage::finish(Sweep& sweep) noexcept {
  if (!sweep.header.is_posed()) return;
  const Instants instants = instants_of(sweep.header);
  load_sources(sweep, instants);
  if (started_) {
    advance(sweep, instants);
  } else {
    start(sweep, instants);
  }
  load_targets(sweep, instants);
  build_targets(twist_);
  last_ = instants;
}

// Poses are chained between the middles of sweeps: an error of the velocity moves the returns of a sweep's
// two halves to opposite sides and cancels. Between ends it would move all to one side, and the chain of ever
// new de-skewed targets hands such an error on, with alternating sign, undamped.
OdometryStage::Instants OdometryStage::instants_of(const SweepHeader& header) const noexcept {
  const std::int64_t mid_ns = header.start_ns + (header.end_ns - header.start_ns) / 2;
  if (header.has(kCompensated)) return {mid_ns, mid_ns, true};
  switch (config_.pose_instant) {
    case PoseInstant::kStart:
      return {mid_ns, header.start_ns, false};
    case PoseInstant::kEnd:
      return {mid_ns, header.end_ns, false};
    case PoseInstant::kMid:
      break;
  }
  return {mid_ns, mid_ns, false};
}

namespace {

/// Seconds from a return's firing to the reference instant.
float before(const Sweep& sweep, std::uint32_t i, std::int64_t reference_ns) noexcept {
  return static_cast<float>(seconds(reference_ns - sweep.header.start_ns - sweep.time_offset_ns[i]));
}

void add_to(FeatureCloud& cloud, const Sweep& sweep, std::uint32_t i, std::int64_t reference_ns) noexcept {
  cloud.add({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, before(sweep, i, reference_ns), sweep.ring[i]);
}

void load(FeatureSet& set,
          const Sweep& sweep,
          std::int64_t reference_ns,
          const FixedVector<std::uint32_t>& edges,
          const FixedVector<std::uint32_t>& planars) noexcept {
  set.edges.size = set.ground.size = set.walls.size = 0;
  for (const std::uint32_t i : edges) add_to(set.edges, sweep, i, reference_ns);
  for (const std::uint32_t i : planars) {
    add_to(sweep.ground[i] == kGround ? set.ground : set.walls, sweep, i, reference_ns);
  }
}

}  // namespace

void OdometryStage::load_sources(const Sweep& sweep, const Instants& instants) noexcept {
  load(sources_, sweep, instants.reference_ns, sweep.features.sharp_edges, sweep.features.flat_planars);
}

void OdometryStage::load_targets(const Sweep& sweep, const Instants& instants) noexcept {
  load(raw_targets_, sweep, instants.reference_ns, sweep.features.edges, sweep.features.planars);
  targets_compensated_ = instants.compensated;
}

void OdometryStage::build_targets(const Vector6d& twist) noexcept {
  const Vector6d used = targets_compensated_ || !config_.deskew ? Vector6d::Zero() : twist;
  deskew(raw_targets_.edges, used, deskewed_);
  targets_.edges.build(deskewed_);
  deskew(raw_targets_.ground, used, deskewed_);
  targets_.ground.build(deskewed_);
  deskew(raw_targets_.walls, used, deskewed_);
  targets_.walls.build(deskewed_);
}

void OdometryStage::start(Sweep& sweep, const Instants& instants) noexcept {
  started_ = true;
  sweep.estimate.health = Health::kInit;
  sweep.estimate.reason = HealthReason::kFirstSweep;
  sweep.estimate.covariance = prior_information().inverse();
  report(sweep, instants);
}

void OdometryStage::advance(Sweep& sweep, const Instants& instants) noexcept {
  double period_s = seconds(instants.reference_ns - last_.reference_ns);
  const bool is_time_lost = period_s <= 0.0 || period_s > kLongestGap_s;  // the sensor's clock began anew
  if (is_time_lost) {
    period_s = seconds(sweep.header.end_ns - sweep.header.start_ns);
    if (period_s <= 0.0) period_s = kNominalSweep_s;
    twist_.setZero();
    has_motion_ = false;
  }
  const Eigen::Isometry3d T_predicted = exp_se3(twist_ * std::min(period_s, kLongestPrediction_s));
  const double deskew_period_s = instants.compensated ? 0.0 : period_s;

  const RegistrationResult result = has_motion_ ? registration_.align(sources_, targets_, T_predicted,
                                                                      deskew_period_s, config_.match_radius_m)
                                                : find_first_motion(instants.compensated ? 0.0 : period_s);
  HealthReason reason = judge(result, T_predicted);

  const bool usable = reason == HealthReason::kNone || reason == HealthReason::kNotObservable;
  const Eigen::Isometry3d T_last_this = usable ? result.T_target_source : T_predicted;
  if (usable && !is_placed_) {
    // The first sweep's pose was published as the identity at its reported instant; place its reference
    // accordingly.
    const Vector6d twist = log_se3(T_last_this) / period_s;
    T_odom_reference_ = exp_se3(twist * seconds(last_.reference_ns - last_.reported_ns));
    is_placed_ = true;
  }
  T_odom_reference_ = T_odom_reference_ * T_last_this;
  if (usable) {
    twist_ = log_se3(T_last_this) / period_s;
    has_motion_ = true;
  }
  if (is_time_lost || period_s > kLongestPrediction_s) reason = HealthReason::kTimeGap;
  if (reason == HealthReason::kNone && sweep.header.has(kIncomplete)) reason = HealthReason::kIncompleteSweep;
  adopt(sweep.estimate, result, reason, period_s);
  report(sweep, instants);
}

namespace {

void thin(const FeatureCloud& all, FeatureCloud& few) noexcept {
  few.size = 0;
  for (std::size_t i = 0; i < all.size; i += kOneOf) few.add(all.point(i), all.before_s[i], all.ring[i]);
}

}  // namespace

// Nothing says how fast the vehicle moves when the sensor is switched on, and until that is known both sweeps
// are distorted: try several speeds with some of the features, de-skew both sweeps by each, and go on with
// the two that are best supported. A live run has less than 0.3 s for this before sweeps are dropped.
RegistrationResult OdometryStage::find_first_motion(double period_s) noexcept {
  constexpr std::array<double, 7> kForward_m{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0};
  thin(sources_.edges, few_sources_.edges);
  thin(sources_.ground, few_sources_.ground);
  thin(sources_.walls, few_sources_.walls);
  const auto align = [&](const FeatureSet& sources, const Eigen::Isometry3d& T_guess, double radius_m) {
    if (period_s > 0.0) build_targets(log_se3(T_guess) / period_s);
    return registration_.align(sources, targets_, T_guess, period_s, radius_m);
  };
  RegistrationResult best, second;
  for (const double forward_m : kForward_m) {
    Eigen::Isometry3d T_guess = Eigen::Isometry3d::Identity();
    T_guess.translation().x() = forward_m;
    RegistrationResult result = align(few_sources_, T_guess, config_.start_match_radius_m);
    if (result.score > best.score) std::swap(result, best);
    if (result.score > second.score) second = result;
  }
  for (RegistrationResult* seed : {&best, &second}) {
    for (int pass = 0; pass < 2; ++pass) {
      *seed = align(sources_, seed->T_target_source, config_.match_radius_m);
    }
  }
  return best.score >= second.score ? best : second;
}

HealthReason OdometryStage::judge(const RegistrationResult& result,
                                  const Eigen::Isometry3d& T_predicted) const noexcept {
  if (!result.T_target_source.matrix().allFinite() || !result.information.allFinite())
    return HealthReason::kNotFinite;
  if (static_cast<int>(result.ground_matches) < config_.min_planar_matches ||
      static_cast<int>(result.edge_matches + result.wall_matches) < config_.min_edge_matches) {
    return HealthReason::kTooFewFeatures;
  }
  const Vector6d correction = log_se3(T_predicted.inverse() * result.T_target_source);
  if (has_motion_ && (correction.head<3>().norm() > config_.max_correction_m ||
                      correction.tail<3>().norm() > config_.max_correction_deg * std::numbers::pi / 180.0)) {
    return HealthReason::kImplausibleMotion;
  }
  if (observability(result.information) < config_.min_information_ratio) return HealthReason::kNotObservable;
  return HealthReason::kNone;
}

void OdometryStage::adopt(Estimate& estimate,
                          const RegistrationResult& result,
                          HealthReason reason,
                          double period_s) noexcept {
  const bool registered = reason == HealthReason::kNone || reason == HealthReason::kNotObservable ||
                          reason == HealthReason::kIncompleteSweep;
  predicted_in_a_row_ = registered ? 0 : predicted_in_a_row_ + 1;
  estimate.reason = reason;
  if (reason == HealthReason::kNone) {
    estimate.health = Health::kOk;
  } else {
    estimate.health = predicted_in_a_row_ >= config_.lost_after ? Health::kLost : Health::kDegraded;
  }
  // A prediction is as uncertain as the motion prior, and more so the longer nothing confirmed it.
  Matrix6d information = prior_information() / std::max(1.0, std::pow(period_s / 0.1, 2.0));
  if (registered) {
    information += result.information;
  } else {
    information /= static_cast<double>(predicted_in_a_row_ * predicted_in_a_row_);
  }
  estimate.covariance = inverse_of(information);
  estimate.iterations = static_cast<std::uint16_t>(result.rounds);
  estimate.edge_matches = result.edge_matches;
  estimate.planar_matches = result.ground_matches + result.wall_matches;
  estimate.edge_rms_m = static_cast<float>(result.edge_rms_m);
  estimate.planar_rms_m = static_cast<float>(result.ground_rms_m);
}

void OdometryStage::report(Sweep& sweep, const Instants& instants) noexcept {
  Estimate& estimate = sweep.estimate;
  estimate.has_pose = true;
  estimate.stamp_ns = instants.reported_ns;
  estimate.twist = twist_;
  const Eigen::Isometry3d T_reference_reported =
      exp_se3(twist_ * seconds(instants.reported_ns - instants.reference_ns));
  estimate.T_odom_sensor_front_end = T_odom_reference_ * T_reference_reported;
  estimate.T_odom_sensor_first = estimate.T_odom_sensor_front_end;
  estimate.T_odom_sensor_refined = estimate.T_odom_sensor_front_end;
}

}  // namespace pago::odometry
