// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/keyframe_mapping.hpp"

#include <array>

#include "five_point_registration.hpp"
#include "pago/core/deskew.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/core/units.hpp"
#include "pago/registration/motion_model.hpp"
#include "pago/registration/voxel_means.hpp"

namespace pago::mapping {

namespace {

/// A sweep's features at its reference instant.
class FeatureReader {
 public:
  FeatureReader(const Sweep& sweep, const Vector6d& twist) : sweep_(sweep), to_reference_(twist) {}

  Eigen::Vector3f operator()(std::uint32_t i) const noexcept {
    return to_reference_({sweep_.x_m[i], sweep_.y_m[i], sweep_.z_m[i]}, sweep_.before_reference_s(i));
  }
  std::vector<Eigen::Vector3f> all(std::span<const std::uint32_t> list) const {
    std::vector<Eigen::Vector3f> points;
    for (const std::uint32_t i : list) points.push_back((*this)(i));
    return points;
  }

 private:
  const Sweep& sweep_;
  Deskew to_reference_;
};

struct ScanClouds {
  FeatureClouds registered;  ///< planars and outliers in one, thinned once more
  FeatureClouds kept;        ///< what a keyframe keeps: planars and outliers thinned apart
};

ScanClouds clouds_of(const Sweep& sweep, const KeyframeMapConfig& config, const Vector6d& twist) {
  using registration::voxel_means;
  const FeatureReader read(sweep, twist);
  const FeatureLists& lists = sweep.features;
  ScanClouds clouds;
  voxel_means(read.all(lists.edges.view()), config.edge_voxel_m, clouds.registered.edges);
  std::vector<Eigen::Vector3f> by_row;
  for (std::size_t row = 0; row < kNumRings; ++row) {
    const std::uint32_t begin = lists.planar_rows[row], end = lists.planar_rows[row + 1];
    voxel_means(read.all(lists.planars.view().subspan(begin, end - begin)), config.row_voxel_m, by_row);
  }
  voxel_means(by_row, config.planar_voxel_m, clouds.kept.planars);
  voxel_means(read.all(lists.outliers.view()), config.planar_voxel_m, clouds.kept.planars);
  voxel_means(clouds.kept.planars, config.planar_voxel_m, clouds.registered.planars);
  clouds.kept.edges = clouds.registered.edges;
  return clouds;
}

}  // namespace

struct KeyframeMapping::Parts {
  explicit Parts(const KeyframeMapConfig& config) : store(config), registration(config) {}
  KeyframeStore store;
  FivePointRegistration registration;
};

KeyframeMapping::KeyframeMapping(const MappingConfig& config)
    : config_(config), parts_(std::make_unique<Parts>(config.keyframe_map)), saved_(config.keyframes) {}
KeyframeMapping::~KeyframeMapping() = default;

void KeyframeMapping::reset() noexcept {
  parts_->store.clear();
  saved_.reset();
  refined_ = {};
  refined_.twist.setZero(), refined_.acceleration.setZero();
  T_odometry_.setIdentity(), T_correction_.setIdentity(), T_map_reference_.setIdentity();
  last_registered_at_.setZero();
  sweeps_ = 0;
}

bool KeyframeMapping::is_due(const ScanMotion& motion) noexcept {
  const bool has_turn = sweeps_++ % static_cast<std::uint64_t>(config_.keyframe_map.every_sweeps) == 0;
  if (!has_turn) return false;
  const double since_s = seconds(motion.reference_ns - last_registered_ns_);
  if (parts_->store.size() > 0 && !motion.is_time_lost && since_s < config_.keyframe_map.min_interval_s)
    return false;
  last_registered_ns_ = motion.reference_ns;
  return true;
}

void KeyframeMapping::finish(Sweep& sweep) noexcept {
  if (!sweep.header.is_posed()) return;
  const ScanMotion& motion = sweep.motion;
  const Eigen::Isometry3d T_map_last = T_map_reference_;
  T_odometry_ = orthonormalized(T_odometry_ * motion.T_last_this);
  T_map_reference_ = orthonormalized(T_correction_ * T_odometry_);
  if (is_due(motion)) register_to_map(sweep);
  if (refined_.is_placed && motion.period_s > 0.0)
    refined_.twist = log_se3(T_map_last.inverse() * T_map_reference_) / motion.period_s;
  report(motion, sweep.estimate);
}

void KeyframeMapping::register_to_map(Sweep& sweep) noexcept {
  KeyframeStore& store = parts_->store;
  const ScanMotion& motion = sweep.motion;
  Estimate& estimate = sweep.estimate;
  Vector6d twist = Vector6d::Zero();
  if (config_.keyframe_map.deskew && !motion.is_compensated && motion.period_s > 0.0)
    twist = log_se3(motion.T_last_this) / motion.period_s;
  const ScanClouds scan = clouds_of(sweep, config_.keyframe_map, twist);
  if (store.size() == 0) {
    store.add(T_map_reference_, scan.kept);
    return;
  }
  const FivePointResult result =
      parts_->registration.align(store.map_around(last_registered_at_), scan.registered, T_map_reference_);
  estimate.iterations = static_cast<std::uint16_t>(result.iterations);
  estimate.map_points = result.offered, estimate.map_matches = result.matches;
  estimate.map_rms_m = static_cast<float>(result.rms_m);
  if (result.is_registered && result.T_map_sensor.matrix().allFinite()) {
    T_map_reference_ = result.T_map_sensor;
    T_correction_ = T_map_reference_ * T_odometry_.inverse();
    const double variance_m2 = config_.point_sigma_m * config_.point_sigma_m;
    estimate.covariance =
        inverse_of(result.H / variance_m2 + registration::predicted_information(motion.period_s, 0));
  }
  last_registered_at_ = T_map_reference_.translation();
  const double apart_m = (T_map_reference_.translation() - store.last_position()).norm();
  if (apart_m >= config_.keyframe_map.keyframe_distance_m) store.add(T_map_reference_, scan.kept);
}

void KeyframeMapping::report(const ScanMotion& motion, Estimate& estimate) noexcept {
  refined_.is_placed = refined_.has_motion = true;
  refined_.period_s = motion.period_s;
  refined_.T_odom_reference = T_map_reference_;
  estimate.is_keyframe = saved_.take(T_map_reference_);
  const double reported_s = seconds(motion.reported_ns - motion.reference_ns);
  estimate.twist = refined_.twist_at(reported_s);
  estimate.T_odom_sensor_refined =
      T_map_reference_ * exp_se3(reported_s * refined_.twist_at(0.5 * reported_s));
}

}  // namespace pago::mapping
