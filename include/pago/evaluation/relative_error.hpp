// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pago/evaluation/association.hpp"

namespace pago::evaluation {

/// The KITTI odometry devkit's choice of segments.
struct SegmentOptions {
  std::vector<double> lengths_m{100, 200, 300, 400, 500, 600, 700, 800};  ///< each > 0
  int step_rows = 10;           ///< a segment starts at every step-th row of the base; >= 1
  double row_interval_s = 0.1;  ///< between rows without stamps, for speeds; > 0
};

/// Motion error over one segment: E = inv(estimated motion) * true motion, in the sensor frame at the
/// segment's end as estimated (x forward, y left, z up), divided by the nominal length.
struct SegmentError {
  std::size_t first = 0, last = 0;  ///< indices into MatchedTrajectories::poses
  double length_m = 0.0;
  double speed_m_per_s = 0.0;       ///< length / time from the first row to the last
  double translation = 0.0;         ///< |t of E| / length, m per m
  double rotation_rad_per_m = 0.0;  ///< angle of E / length
  Eigen::Vector3d translation_per_axis = Eigen::Vector3d::Zero();         ///< x y z, signed, m per m
  Eigen::Vector3d rotation_rad_per_m_per_axis = Eigen::Vector3d::Zero();  ///< roll pitch yaw, signed
};

/// Means over segments. NaN when there are none.
struct DriftRates {
  std::size_t num_segments = 0;
  double length_m = 0.0;       ///< of the segments; 0 where lengths are mixed
  double speed_m_per_s = 0.0;  ///< about which the segments' are; 0 where speeds are mixed
  double t_rel_percent = 0.0;
  double r_rel_deg_per_100m = 0.0;  ///< degrees per HUNDRED metres (KISS-ICP prints degrees per metre)
  Eigen::Vector3d axis_percent = Eigen::Vector3d::Zero();       ///< mean magnitude along x y z
  Eigen::Vector3d axis_deg_per_100m = Eigen::Vector3d::Zero();  ///< mean magnitude of roll pitch yaw
};

struct RelativeErrors {
  std::vector<SegmentError> segments;
  DriftRates overall;                 ///< mean over all segments (not the mean of the lengths' means)
  std::vector<DriftRates> by_length;  ///< lengths without a segment are left out
  /// About 2, 4, 6, ... m/s: segments less than 2 m/s off, so that each is in two of them; at least 3.
  std::vector<DriftRates> by_speed;
  std::size_t num_skipped = 0;  ///< segments with an end that the estimate has no pose for
};

/// Errors of the KITTI devkit: from every step-th row to the first row whose distance along the true path is
/// greater by more than the length; segments with a missing estimate at an end are skipped. Error for a
/// length or step that is not positive.
RelativeErrors relative_errors(const MatchedTrajectories& matched, const SegmentOptions& options = {});

/// The means over any set of segments: of several runs together, of one length, of one speed.
DriftRates drift_rates(const std::vector<SegmentError>& segments);

}  // namespace pago::evaluation
