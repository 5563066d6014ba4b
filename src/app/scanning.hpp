// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/evaluation/scan_statistics.hpp"
#include "pago/pipeline/odometry.hpp"

namespace pago::app {

/// Poses for the middle of each sweep, so that sweeps can be laid over each other; and ground masks.
class Placing {
 public:
  explicit Placing(const Config& config);

  /// The sweep gets its ground mask. Throws Error if it cannot be used.
  pago::Estimate place(Sweep& sweep);

 private:
  Odometry odometry_;
  std::vector<Eigen::Vector3f> points_m_;
  std::vector<float> times_s_;
};

/// What a drive's sweeps look like, one after the other.
class Scanning {
 public:
  explicit Scanning(const Config& config) : placing_(config) {}

  void add(Sweep& sweep);
  evaluation::ScanStatistics& statistics() { return statistics_; }

 private:
  Placing placing_;
  evaluation::ScanStatistics statistics_;
  evaluation::Cloud last_;  // in its own frame
  Eigen::Isometry3d T_odom_last_ = Eigen::Isometry3d::Identity();
};

}  // namespace pago::app
