// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/mapping.hpp"

#include "pago/core/se3.hpp"
#include "pago/core/symmetric6.hpp"

namespace pago::mapping {

namespace {

constexpr double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

registration::CellMapOptions options_of(const CellsConfig& c) {
  return {registration::CellShape::kPlane, c.cell_m, c.max_points, c.min_points, c.max_flatness, c.max_thickness_m, c.min_width_m};
}

}  // namespace

MappingStage::MappingStage(const MappingConfig& config)
    : config_(config),
      map_(options_of(config.cells), static_cast<std::uint32_t>(config.cells.max_cells)),
      registration_(config, kMaxKeyPoints),
      key_points_(kMaxKeyPoints),
      map_points_(kMaxMapPoints) {}

void MappingStage::finish(Sweep& sweep) noexcept {
  if (!sweep.header.is_posed()) return;
  const ScanMotion& motion = sweep.motion;
  if (started_ && !is_placed_) {
    map_.clear();
    insert(motion.is_compensated ? Vector6d::Zero() : Vector6d(log_se3(motion.T_last_this) / motion.period_s));
  }
  load(sweep);
  if (!started_) {
    started_ = true;
    first_reference_ns_ = motion.reference_ns, first_reported_ns_ = motion.reported_ns;
    insert(Vector6d::Zero());
    report(sweep);
    return;
  }
  MotionGuess guess;
  guess.T_map_last = T_map_reference_;
  guess.T_last_this = motion.T_last_this;
  static const double PF = getenv("PF") ? atof(getenv("PF")) : 0.0;
  guess.information = motion.information * PF;
  guess.period_s = motion.period_s;
  guess.is_compensated = motion.is_compensated;
  const JointResult result = registration_.align(map_, key_points_, guess);
  T_map_reference_ = T_map_reference_ * result.T_last_this;
  twist_ = log_se3(result.T_last_this) / motion.period_s;
  at_reference_ = result.twist;
  if (!is_placed_) {
    is_placed_ = true;
    T_odom_map_ = exp_se3(twist_ * seconds(first_reference_ns_ - first_reported_ns_));
  }
  refined_ = {true, T_odom_map_ * T_map_reference_};
  insert(result.twist);
  map_.prune(T_map_reference_.translation(), config_.cells.radius_m, map_.num_slots() / 16);
  sweep.estimate.iterations = static_cast<std::uint16_t>(result.iterations);
  sweep.estimate.planar_matches = result.matches;
  sweep.estimate.planar_rms_m = static_cast<float>(result.rms_m);
  sweep.estimate.covariance = inverse_of(result.information);
  report(sweep);
}

void MappingStage::load(const Sweep& sweep) noexcept {
  const std::int64_t reference_ns = sweep.motion.reference_ns - sweep.header.start_ns;
  const auto copy = [&](const FixedVector<std::uint32_t>& list, registration::PointCloud& out) {
    out.size = 0;
    for (const std::uint32_t i : list) {
      const float before_s = sweep.motion.is_compensated
                                 ? 0.0F
                                 : static_cast<float>(reference_ns - sweep.time_offset_ns[i]) * 1e-9F;
      out.add({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, before_s, sweep.ground[i]);
    }
  };
  copy(sweep.features.key_points, key_points_);
  copy(sweep.features.map_points, map_points_);
}

void MappingStage::insert(const Vector6d& twist) noexcept {
  const registration::Deskew to_reference(twist);
  for (std::size_t i = 0; i < map_points_.size; ++i) {
    const Eigen::Vector3f p = to_reference(map_points_.point(i), map_points_.before_s[i]);
    map_.insert(T_map_reference_ * p.cast<double>(), map_points_.tag[i]);
  }
}

void MappingStage::report(Sweep& sweep) noexcept {
  const double ahead_s = seconds(sweep.motion.reported_ns - sweep.motion.reference_ns);
  // At the middle of the way there: the change of velocity goes on.
  const Vector6d twist = sweep.motion.is_compensated ? twist_ : at_reference_;
  sweep.estimate.T_odom_sensor_refined = T_odom_map_ * T_map_reference_ * exp_se3(twist * ahead_s);
}

}  // namespace pago::mapping
