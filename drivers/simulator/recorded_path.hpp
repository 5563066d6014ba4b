// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "route.hpp"

namespace pago::simulator {

/// A drive that somebody else has driven: a street along it, and where on its way the vehicle was.
struct RecordedPath {
  static constexpr double kInterval_s = 0.1;  ///< between poses

  Route route;
  std::vector<double> distances_m;  ///< along the way, of each pose of the file; the pace is smoothed

  /// Distance at a time after the first pose: a cubic B-spline over distances_m, without jumps of speed.
  double distance_m(double t_s) const noexcept;
  double duration_s() const noexcept { return kInterval_s * static_cast<double>(distances_m.size() - 1); }
};

/// Reads poses of a camera 1.65 m above the ground (12 numbers a line, x right, y down, z forward, 0.1 s
/// apart; KITTI's files) and lays a street under them, whose middle is `lane_m` to
/// the left of the way. Heights are those of the file, made to agree where the
/// way comes back to a place: there the official poses differ by metres, and the difference is spread evenly
/// over what lies between the visits. Where it goes along a street again, that stretch is not furnished a
/// second time. Throws Error for a file that cannot be read, is too short or drives backwards.
RecordedPath read_path(const std::filesystem::path& file, double half_width_m, double lane_m);

}  // namespace pago::simulator
