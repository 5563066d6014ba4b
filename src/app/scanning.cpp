// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scanning.hpp"

#include <algorithm>
#include <string>

#include "pago/core/deskew.hpp"
#include "pago/core/error.hpp"

namespace pago::app {
namespace {

Config with_middle(Config config) {
  config.odometry.pose_instant = PoseInstant::kMid;
  config.assembly.max_returns = static_cast<int>(max_returns_of(config.assembly, /*can_be_dual=*/true));
  return config;
}

/// The returns as from the middle of the sweep, in the frame of another place.
evaluation::Cloud at_rest(const Sweep& sweep,
                          const pago::Estimate& estimate,
                          const Eigen::Isometry3d& T_there_here) {
  const Deskew deskew(sweep.header.has(kCompensated) ? Vector6d::Zero().eval() : estimate.twist);
  const std::int64_t middle_ns = (sweep.header.end_ns - sweep.header.start_ns) / 2;
  const Eigen::Isometry3f T = T_there_here.cast<float>();
  evaluation::Cloud cloud;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3f p(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    if (p.isZero(0.0F)) continue;
    const auto before_s = static_cast<float>(middle_ns - sweep.time_offset_ns[i]) * 1e-9F;
    cloud.push_back(T * deskew(p, before_s));
  }
  return cloud;
}

}  // namespace

Placing::Placing(const Config& config) : odometry_(with_middle(config)) {}

pago::Estimate Placing::place(Sweep& sweep) {
  const bool is_compensated = sweep.header.has(kCompensated);
  points_m_.clear();
  times_s_.clear();
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    points_m_.emplace_back(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    if (!is_compensated) times_s_.push_back(static_cast<float>(sweep.time_offset_ns[i]) * 1e-9F);
  }
  const std::int64_t duration_ns = sweep.header.end_ns - sweep.header.start_ns;
  const pago::Estimate estimate = odometry_.process({.points_m = points_m_,
                                                     .times_s = times_s_,
                                                     .rings = sweep.ring.first(sweep.size),
                                                     .stamp_ns = sweep.header.start_ns,
                                                     .duration_ns = duration_ns});
  if (!odometry_.refusal().empty())
    throw Error("sweep " + std::to_string(sweep.header.sequence), std::string(odometry_.refusal()));
  std::ranges::copy(odometry_.ground(), sweep.ground.begin());
  return estimate;
}

void Scanning::add(Sweep& sweep) {
  const pago::Estimate estimate = placing_.place(sweep);
  add_returns(sweep, statistics_);
  add_ground_patches(sweep, statistics_);
  add_surfaces(sweep, statistics_);
  const Eigen::Isometry3d& T_odom_sensor = estimate.T_odom_sensor_refined;
  if (estimate.health == Health::kOk && !last_.empty())
    add_overlap(last_, at_rest(sweep, estimate, T_odom_last_.inverse() * T_odom_sensor), statistics_);
  // What was placed by a guess is nothing to lie on.
  last_ = estimate.health == Health::kOk ? at_rest(sweep, estimate, Eigen::Isometry3d::Identity())
                                         : evaluation::Cloud{};
  T_odom_last_ = T_odom_sensor;
}

}  // namespace pago::app
