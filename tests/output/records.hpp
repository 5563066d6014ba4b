// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/output/sweep_record.hpp"

namespace pago::test {

/// Sweep `sequence` of a car that drives 1 m per sweep, with times of the stages up to odometry: closed at
/// 100 ms, ground 101-104, features 104-108, odometry waits 2 ms and runs 110-115.
inline output::SweepRecord record(std::uint64_t sequence) {
  constexpr std::int64_t kMs = 1'000'000;
  const std::int64_t start_ns = static_cast<std::int64_t>(sequence) * 100 * kMs;
  output::SweepRecord r;
  r.header.sequence = sequence;
  r.header.closed_ns = r.header.complete_ns = start_ns + 100 * kMs;
  r.stamp_ns = 1'317'378'034'000'000'000 + start_ns;
  r.T_odom_sensor_first[3] = r.T_odom_sensor_refined[3] = static_cast<double>(sequence);
  r.has_pose = true;
  r.health = sequence == 0 ? Health::kInit : Health::kOk;
  r.times[0] = {start_ns + 1, start_ns + 100 * kMs, 2 * kMs};
  r.times[1] = {start_ns + 101 * kMs, start_ns + 104 * kMs, 3 * kMs};
  r.times[2] = {start_ns + 104 * kMs, start_ns + 108 * kMs, 4 * kMs};
  r.times[3] = {start_ns + 110 * kMs, start_ns + 115 * kMs, 5 * kMs};
  return r;
}

}  // namespace pago::test
