// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pago/evaluation/trajectory.hpp"

namespace pago::evaluation {

/// How the poses of the two files find each other.
enum class Matching {
  kAuto,   ///< by stamp when both files have stamps, else by row
  kRow,    ///< row i belongs to row i; the files must have equally many rows unless rows are chosen
  kStamp,  ///< nearest stamp within a maximum difference
};

/// Rows first to last, both included, counted from 0.
struct RowRange {
  std::size_t first = 0, last = 0;
};

/// Reads "A-B". Error when it is not that, or A > B.
RowRange parse_row_range(std::string_view text);

struct MatchOptions {
  Matching matching = Matching::kAuto;
  /// Score only these rows: of both files by row, of the base by stamp.
  std::optional<RowRange> rows = std::nullopt;
  double max_difference_s = 0.02;  ///< by stamp: poses farther apart do not match; > 0
  /// By stamp: truth is interpolated (slerp, lerp) to the estimate's stamps, as it always is where it has
  /// more than twice the estimate's rate.
  bool interpolates_truth = false;
  double time_offset_s =
      0.0;  ///< by stamp: added to the estimate's stamps, to bring its clock to the truth's
  /// By row: how many rows after the truth's instant the estimate's is, e.g. 0.5 where truth holds for the
  /// middle of each sweep and the estimate for its end. Truth is interpolated (constant velocity and turn
  /// rate between rows); rows for which it would have to be extrapolated are left out. Within [-1, 1].
  double instant_shift_rows = 0.0;
};

/// A row of the base trajectory with what belongs to it. The base is the truth; by stamp it
/// is the estimate where the truth's rate is more than twice its own (a 200 Hz truth) or truth is
/// interpolated.
struct MatchedPose {
  std::size_t row = 0;                   ///< in the base's file
  std::optional<std::int64_t> stamp_ns;  ///< of that row
  Eigen::Isometry3d T_world_sensor_truth = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_world_sensor_estimate;  ///< empty: the estimate has no pose for this row
  std::size_t estimate_row = 0;                              ///< in the estimate's file, where it has a pose
};

/// Rows of the base in order, never re-numbered: a row without estimate stays in the list and leaves a hole,
/// so that what is scored does not depend on what is missing.
struct MatchedTrajectories {
  std::vector<MatchedPose> poses;
  std::string how;  ///< "by row", "by stamp within 0.020 s", ... for the report
  /// Whole sentences. With the estimate as the base, what it lacks is no row: how much that is stands here.
  std::vector<std::string> notes{};

  std::size_t num_matched() const noexcept;
};

/// Brings the two files together. Error when they do not fit: differing row counts without chosen rows, rows
/// beyond an end, stamps asked for where there are none, no two stamps close enough.
MatchedTrajectories match(const Trajectory& truth, const Trajectory& estimate, const MatchOptions& options);

}  // namespace pago::evaluation
