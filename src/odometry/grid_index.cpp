// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/grid_index.hpp"

namespace pago::odometry {

void GridIndex::build(const PointCloud& cloud) noexcept {
  std::fill(begin_.begin(), begin_.end(), 0U);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    cell_of_[i] =
        static_cast<std::uint32_t>(cell(cell_coordinate(cloud.x_m[i]), cell_coordinate(cloud.y_m[i])));
    ++begin_[cell_of_[i] + 1];
  }
  for (std::size_t c = 0; c < kCells; ++c) begin_[c + 1] += begin_[c];

  // begin_[c] serves as the write position of cell c and ends as its end, which is the next cell's begin:
  // shift back.
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const std::uint32_t to = begin_[cell_of_[i]]++;
    points_.x_m[to] = cloud.x_m[i], points_.y_m[to] = cloud.y_m[i], points_.z_m[to] = cloud.z_m[i];
    points_.before_s[to] = cloud.before_s[i];
    points_.tag[to] = cloud.tag[i];
  }
  for (std::size_t c = kCells; c > 0; --c) begin_[c] = begin_[c - 1];
  begin_[0] = 0;
  points_.size = cloud.size;
}

std::int32_t GridIndex::nearest(const Eigen::Vector3f& query, float radius_m) const noexcept {
  // Half the radius first: the nearest is usually close, and a small square has few cells.
  for (float reach_m = std::min(0.5F, radius_m);; reach_m = std::min(2.0F * reach_m, radius_m)) {
    std::int32_t best = -1;
    float best_sq = 0.0F;
    for_each_within(query, reach_m, [&](std::uint32_t i, float distance_sq) {
      if (best < 0 || distance_sq < best_sq) {
        best = static_cast<std::int32_t>(i);
        best_sq = distance_sq;
      }
    });
    if (best >= 0 || reach_m >= radius_m) return best;
  }
}

}  // namespace pago::odometry
