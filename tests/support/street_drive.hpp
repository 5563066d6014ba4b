// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/features/features.hpp"
#include "pago/mapping/mapper.hpp"
#include "pago/odometry/odometry.hpp"
#include "support/street.hpp"

namespace pago::test {

inline Vector6d forward(double speed_m_s, double yaw_rad_s = 0.0) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = speed_m_s, twist[5] = yaw_rad_s;
  return twist;
}

/// Drives along the street sweep by sweep, and keeps what odometry and mapping, chained as in the pipeline,
/// say of the last one.
struct StreetDrive {
  explicit StreetDrive(const OdometryConfig& odometry_config = {},
                       const MappingConfig& mapping_config = {},
                       const FeaturesConfig& features_config = {})
      : sweep(kStreetReturns),
        extract(features_config, kStreetReturns),
        mapping(mapping_config),
        odometry(odometry_config, kStreetReturns, mapping.refined()) {}

  const Estimate& next(const Vector6d& twist) {
    street.scan(T_world_start, twist, now_ns, 0.01, sweep);
    return work(twist);
  }
  /// The same with nothing to see, as under a cover.
  const Estimate& next_blind(const Vector6d& twist) {
    sweep.reset();
    sweep.header.start_ns = now_ns;
    sweep.header.end_ns = now_ns + 100'000'000;
    return work(twist);
  }
  /// Time in which nothing comes.
  void skip(const Vector6d& twist, double seconds) {
    T_world_start = T_world_start * exp_se3(twist * seconds);
    now_ns += static_cast<std::int64_t>(seconds * 1e9);
  }
  /// Truth at the end of the last sweep, relative to where the sensor was at `T_world_first`.
  Eigen::Isometry3d T_first_last(const Eigen::Isometry3d& T_world_first) const {
    return T_world_first.inverse() * T_world_start;
  }
  const Eigen::Isometry3d& refined() const { return sweep.estimate.T_odom_sensor_refined; }

  Street street;
  Sweep sweep;
  features::FeaturesStage extract;
  mapping::Mapper mapping;
  odometry::OdometryStage odometry;
  Eigen::Isometry3d T_world_start = street_start();
  std::int64_t now_ns = 1'000'000'000;

 private:
  const Estimate& work(const Vector6d& twist) {
    sweep.header.sequence = sequence_++;
    Update next_targets(odometry);
    Update next_map(mapping);
    Chain stages(extract, odometry, mapping, next_targets, next_map);
    stages.process(sweep);
    skip(twist, 0.1);
    return sweep.estimate;
  }

  std::uint64_t sequence_ = 0;
};

}  // namespace pago::test
