// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/run_report.hpp"

namespace pago::output {

void RunTotals::add(const SweepRecord& record) noexcept {
  latency.add(record);
  const SweepHeader& header = record.header;
  const bool is_partial = header.has(kPartialStart) || header.has(kPartialEnd);
  partial += is_partial ? 1U : 0U;
  superseded += !is_partial && header.has(kSuperseded) ? 1U : 0U;
  begins_anew_ = begins_anew_ || header.has(kAfterReset);
  if (!record.has_pose) return;
  const Eigen::Vector3d position_m = to_isometry(record.T_odom_sensor_refined).translation();
  if (num_poses == 0) {
    first_stamp_ns = record.stamp_ns;
  } else if (!begins_anew_) {
    length_m += (position_m - last_position_m_).norm();
  }
  begins_anew_ = false;
  last_position_m_ = position_m;
  last_stamp_ns = record.stamp_ns;
  ++num_poses;
  ++health[static_cast<std::size_t>(record.health)];
  hash.add(record.T_odom_sensor_first);
  hash.add(record.T_odom_sensor_refined);
}

}  // namespace pago::output
