// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <type_traits>

#include "pago/core/sweep.hpp"

namespace pago::output {

/// A rigid motion as plain numbers: the upper 3 x 4 of its matrix, row by row, as KITTI writes it.
using PoseRow = std::array<double, 12>;
inline constexpr PoseRow kIdentityRow{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// [any thread] real-time safe, bit for bit.
PoseRow to_row(const Eigen::Isometry3d& T) noexcept;
Eigen::Isometry3d to_isometry(const PoseRow& row) noexcept;

/// All that leaves the estimate thread about a sweep: what remains when the sweep itself is recycled. Plain
/// bytes, so that it can travel through an SpscQueue to the publisher. Fields as in SweepHeader and Estimate.
struct SweepRecord {
  SweepHeader header;

  std::int64_t stamp_ns = 0;  ///< time of day: the estimate's sensor time and header.clock_offset_ns
  PoseRow T_odom_sensor_front_end = kIdentityRow;
  PoseRow T_odom_sensor_first = kIdentityRow;
  PoseRow T_odom_sensor_refined = kIdentityRow;
  std::array<double, 36> covariance{};  ///< row by row
  Health health = Health::kInit;
  HealthReason reason = HealthReason::kFirstSweep;
  bool has_pose = false;
  std::uint16_t rounds = 0;
  std::uint32_t edge_matches = 0, planar_matches = 0;
  float edge_rms_m = 0.0F, planar_rms_m = 0.0F;
  std::uint16_t iterations = 0;
  bool is_cut_short = false;
  std::uint8_t weak_directions = 0;
  std::uint32_t map_points = 0, map_matches = 0;
  float map_rms_m = 0.0F, map_score = 0.0F;

  std::array<StageTime, kNumStages> times{};

  std::uint32_t num_returns = 0, num_ground = 0;
  std::uint32_t num_sharp_edges = 0, num_edges = 0, num_flat_planars = 0, num_planars = 0;

  const StageTime& time_of(StageId stage) const noexcept { return times[static_cast<std::size_t>(stage)]; }
};
static_assert(std::is_trivially_copyable_v<SweepRecord>);

/// [estimate thread] Real-time safe; about 10 us, most of it counting ground returns.
SweepRecord make_record(const Sweep& sweep) noexcept;

}  // namespace pago::output
