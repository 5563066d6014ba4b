// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/clustering.hpp"

#include <Eigen/Core>
#include <bit>
#include <cmath>

#include "pago/core/units.hpp"

namespace pago::features {

namespace {

constexpr std::uint16_t kUnlabelled = 0;

Eigen::Vector3f point(const Sweep& sweep, std::uint32_t i) {
  return {sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]};
}

/// A cell's return if it is an obstacle, else RangeImage::kEmpty.
std::int32_t obstacle(const Sweep& sweep, int ring, int column) noexcept {
  const std::int32_t i = sweep.range_image.at(ring, column);
  if (i == RangeImage::kEmpty || sweep.ground[static_cast<std::uint32_t>(i)] == kGround)
    return RangeImage::kEmpty;
  return i;
}

}  // namespace

Clusterer::Clusterer(const ClusteringConfig& config, std::uint32_t max_returns)
    : config_(config), parent_(max_returns), segments_(max_returns), label_of_(max_returns) {
  const double tangent = std::tan(config.join_angle_deg * kDegree);
  tan_join_sq_ = static_cast<float>(tangent * tangent);
}

void Clusterer::label(Sweep& sweep) noexcept {
  for (std::uint32_t i = 0; i < sweep.size; ++i) parent_[i] = i;
  join_neighbours(sweep);
  measure(sweep);

  std::uint16_t next = 1;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (sweep.ground[i] == kGround) {
      sweep.cluster[i] = 0;
      continue;
    }
    const std::uint32_t r = root(i);
    if (label_of_[r] == kUnlabelled) {
      label_of_[r] = is_valid(segments_[r]) && next < kClutter ? next++ : kClutter;
    }
    sweep.cluster[i] = label_of_[r];
  }
}

void Clusterer::join_neighbours(const Sweep& sweep) noexcept {
  const int columns = static_cast<int>(sweep.header.num_columns);
  // Column by column, as the returns of one firing lie side by side in memory.
  for (int column = 0; column < columns; ++column) {
    const int before = column == 0 ? columns - 1 : column - 1;
    std::int32_t below = RangeImage::kEmpty;
    for (int ring = 0; ring < kNumRings; ++ring) {
      const std::int32_t here = obstacle(sweep, ring, column);
      if (here != RangeImage::kEmpty) {
        const auto i = static_cast<std::uint32_t>(here);
        if (below != RangeImage::kEmpty) join_if_smooth(sweep, i, static_cast<std::uint32_t>(below));
        const std::int32_t beside = obstacle(sweep, ring, before);
        if (beside != RangeImage::kEmpty) join_if_smooth(sweep, i, static_cast<std::uint32_t>(beside));
      }
      below = here;
    }
  }
}

// With d1 >= d2 the ranges and a the angle between the beams, the returns belong together when
// atan2(d2 sin a, d1 - d2 cos a) > join angle. Multiplied by d1: |p1 x p2| > tan(join) (d1^2 - p1 . p2).
void Clusterer::join_if_smooth(const Sweep& sweep, std::uint32_t a, std::uint32_t b) noexcept {
  const Eigen::Vector3f pa = point(sweep, a), pb = point(sweep, b);
  const float farther_sq = std::max(pa.squaredNorm(), pb.squaredNorm());
  const float along = farther_sq - pa.dot(pb);
  if (along > 0.0F && pa.cross(pb).squaredNorm() <= tan_join_sq_ * along * along) return;
  const std::uint32_t ra = root(a), rb = root(b);
  if (ra < rb) {
    parent_[rb] = ra;
  } else {
    parent_[ra] = rb;
  }
}

void Clusterer::measure(const Sweep& sweep) noexcept {
  std::fill_n(segments_.data(), sweep.size, Segment{});
  std::fill_n(label_of_.data(), sweep.size, kUnlabelled);
  for (int ring = 0; ring < kNumRings; ++ring) {
    const std::int32_t* row = sweep.range_image.row(ring);
    for (std::uint32_t column = 0; column < sweep.header.num_columns; ++column) {
      if (row[column] == RangeImage::kEmpty) continue;
      Segment& segment = segments_[root(static_cast<std::uint32_t>(row[column]))];
      ++segment.num_points;
      segment.rings |= std::uint64_t{1} << ring;
    }
  }
}

bool Clusterer::is_valid(const Segment& segment) const noexcept {
  const auto points = static_cast<int>(segment.num_points);
  return points >= config_.min_points ||
         (points >= config_.min_points_tall && std::popcount(segment.rings) >= config_.min_rings_tall);
}

std::uint32_t Clusterer::root(std::uint32_t i) noexcept {
  while (parent_[i] != i) {
    parent_[i] = parent_[parent_[i]];
    i = parent_[i];
  }
  return i;
}

}  // namespace pago::features
