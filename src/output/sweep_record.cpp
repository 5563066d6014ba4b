// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/sweep_record.hpp"

#include <algorithm>

namespace pago::output {
namespace {

using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
using RowMajor66 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

std::uint32_t count_ground(const Sweep& sweep) noexcept {
  const auto mask = sweep.ground.first(sweep.size);
  return static_cast<std::uint32_t>(std::count(mask.begin(), mask.end(), kGround));
}

void copy_estimate(const Estimate& estimate, SweepRecord& record) noexcept {
  record.stamp_ns = estimate.stamp_ns;
  record.T_odom_sensor_front_end = to_row(estimate.T_odom_sensor_front_end);
  record.T_odom_sensor_first = to_row(estimate.T_odom_sensor_first);
  record.T_odom_sensor_refined = to_row(estimate.T_odom_sensor_refined);
  Eigen::Map<RowMajor66>(record.covariance.data()) = estimate.covariance;
  record.health = estimate.health;
  record.reason = estimate.reason;
  record.has_pose = estimate.has_pose;
  record.rounds = estimate.rounds;
  record.edge_matches = estimate.edge_matches;
  record.planar_matches = estimate.planar_matches;
  record.edge_rms_m = estimate.edge_rms_m;
  record.planar_rms_m = estimate.planar_rms_m;
  record.iterations = estimate.iterations;
  record.is_cut_short = estimate.is_cut_short;
  record.weak_directions = estimate.weak_directions;
  record.map_points = estimate.map_points;
  record.map_matches = estimate.map_matches;
  record.map_rms_m = estimate.map_rms_m;
  record.map_score = estimate.map_score;
}

}  // namespace

PoseRow to_row(const Eigen::Isometry3d& T) noexcept {
  PoseRow row;
  Eigen::Map<RowMajor34>(row.data()) = T.matrix().topRows<3>();
  return row;
}

Eigen::Isometry3d to_isometry(const PoseRow& row) noexcept {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.matrix().topRows<3>() = Eigen::Map<const RowMajor34>(row.data());
  return T;
}

SweepRecord make_record(const Sweep& sweep) noexcept {
  SweepRecord record;
  record.header = sweep.header;
  copy_estimate(sweep.estimate, record);
  record.stamp_ns += sweep.header.clock_offset_ns;
  record.times = sweep.times;
  record.num_returns = sweep.size;
  record.num_ground = count_ground(sweep);
  record.num_sharp_edges = static_cast<std::uint32_t>(sweep.features.sharp_edges.size());
  record.num_edges = static_cast<std::uint32_t>(sweep.features.edges.size());
  record.num_flat_planars = static_cast<std::uint32_t>(sweep.features.flat_planars.size());
  record.num_planars = static_cast<std::uint32_t>(sweep.features.planars.size());
  return record;
}

}  // namespace pago::output
