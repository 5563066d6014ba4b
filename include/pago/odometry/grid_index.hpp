// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pago/registration/point_cloud.hpp"

namespace pago::odometry {

using registration::PointCloud;

/// Nearest-neighbour index over one sweep's features: a plan grid of 1 m cells, 256 m square about the
/// sensor, filled by a counting sort. Rebuilding takes one pass and no allocation, which a kd-tree does not
/// offer; features of one sweep are spread over the plan, so cells stay small. Tests hold it against
/// nanoflann. [set-up] constructor; [estimate thread] the rest: real-time safe, deterministic (ties: the
/// earlier feature).
class GridIndex {
 public:
  explicit GridIndex(std::size_t capacity) : points_(capacity), cell_of_(capacity), begin_(kCells + 1) {}

  /// Replaces the contents by a copy of the cloud, sorted by cell.
  void build(const PointCloud& cloud) noexcept;

  std::size_t size() const noexcept { return points_.size; }
  const PointCloud& points() const noexcept { return points_; }

  /// Position in points() of the feature nearest to `query` within `radius_m`, or -1.
  std::int32_t nearest(const Eigen::Vector3f& query, float radius_m) const noexcept;

  /// Calls visit(position, squared distance) for every feature within `radius_m` of `query`, in no useful
  /// order.
  template <typename Visit>
  void for_each_within(const Eigen::Vector3f& query, float radius_m, Visit visit) const noexcept {
    const int from_x = cell_coordinate(query.x() - radius_m), to_x = cell_coordinate(query.x() + radius_m);
    const int from_y = cell_coordinate(query.y() - radius_m), to_y = cell_coordinate(query.y() + radius_m);
    for (int cy = from_y; cy <= to_y; ++cy) {
      // Cells of a grid row follow each other in memory.
      const std::uint32_t end = begin_[cell(to_x, cy) + 1];
      for (std::uint32_t i = begin_[cell(from_x, cy)]; i < end; ++i) {
        const float distance_sq = (points_.point(i) - query).squaredNorm();
        if (distance_sq <= radius_m * radius_m) visit(i, distance_sq);
      }
    }
  }

 private:
  static constexpr int kSide = 256;
  static constexpr std::size_t kCells = static_cast<std::size_t>(kSide) * kSide;
  static constexpr float kCellSize_m = 1.0F;

  /// Points beyond the grid count in its outermost cells.
  static int cell_coordinate(float metres) noexcept {
    const float cell = metres / kCellSize_m + kSide / 2;
    if (!(cell > 0.0F)) return 0;  // NaN too
    return cell < kSide - 1 ? static_cast<int>(cell) : kSide - 1;
  }
  static std::size_t cell(int cx, int cy) noexcept { return static_cast<std::size_t>(cy * kSide + cx); }

  PointCloud points_;
  AlignedArray<std::uint32_t> cell_of_;
  AlignedArray<std::uint32_t> begin_;  // of each cell in points_; one past the end for the last
};

}  // namespace pago::odometry
