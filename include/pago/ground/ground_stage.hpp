// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/ground/mount_report.hpp"
#include "pago/ground/segmenter.hpp"

namespace pago::ground {

/// The ground method of a configuration as a stage, with what goes along with it: the check of the mount in
/// the first sweeps, and the estimate of the sensor's height if it is wanted. While the estimate is not
/// there, a sweep is segmented when it is complete. The check costs 0.2 ms in each of the sweeps that it
/// looks at.
///
/// [set-up] the constructor: allocates, throws Error. [front thread] begin, accept, finish: real-time safe.
/// The report may be read by others when the front thread is between two sweeps or has ended.
class GroundStage {
 public:
  GroundStage(const GroundConfig& config, const Mount& mount, std::uint32_t max_returns);
  ~GroundStage();
  GroundStage(GroundStage&&) noexcept;
  GroundStage& operator=(GroundStage&&) noexcept;

  void begin(Sweep& sweep) noexcept;
  void accept(const SweepPart& part) noexcept;
  void finish(Sweep& sweep) noexcept;

  const MountReport& mount_report() const noexcept;
  /// That the method works with: the mount's, or the estimate once there is one.
  double height_m() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pago::ground
