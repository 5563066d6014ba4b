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
std::int32_t obstacle(const FeatureImage& image, int ring, int column) noexcept {
  const std::int32_t i = image.cells.at(ring, column);
  if (i == RangeImage::kEmpty || image.ground[static_cast<std::uint32_t>(i)] == kGround)
    return RangeImage::kEmpty;
  return i;
}

}  // namespace

Clusterer::Clusterer(const ClusteringConfig& config, std::uint32_t max_returns)
    : config_(config),
      tan_join_(std::tan(config.join_angle_deg * kDegree)),
      tan_join_sq_(static_cast<float>(tan_join_ * tan_join_)),
      parent_(max_returns),
      segments_(max_returns),
      label_of_(max_returns) {}

void Clusterer::label(Sweep& sweep, const FeatureImage& image) noexcept {
  for (std::uint32_t i = 0; i < sweep.size; ++i) parent_[i] = i;
  if (config_.neighbours == Neighbours::kFour) {
    join_neighbours(sweep, image);
  } else {
    join_diagonals(sweep, image);
  }
  measure(image, sweep.size);

  std::uint16_t next = 1;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (image.ground[i] == kGround) {
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

void Clusterer::join_neighbours(const Sweep& sweep, const FeatureImage& image) noexcept {
  // Column by column, as the returns of one firing lie side by side in memory.
  for (int column = 0; column < image.columns; ++column) {
    const int before = column == 0 ? image.columns - 1 : column - 1;
    std::int32_t below = RangeImage::kEmpty;
    for (int ring = 0; ring < kNumRings; ++ring) {
      const std::int32_t here = obstacle(image, ring, column);
      if (here != RangeImage::kEmpty) {
        const auto i = static_cast<std::uint32_t>(here);
        if (below != RangeImage::kEmpty)
          join_if_smooth(sweep, i, static_cast<std::uint32_t>(below), image.row_step_rad);
        const std::int32_t beside = obstacle(image, ring, before);
        if (beside != RangeImage::kEmpty)
          join_if_smooth(sweep, i, static_cast<std::uint32_t>(beside), image.column_step_rad);
      }
      below = here;
    }
  }
}

// PaGO-LOAM's code takes the step between rows for these.
void Clusterer::join_diagonals(const Sweep& sweep, const FeatureImage& image) noexcept {
  for (int column = 0; column < image.columns; ++column) {
    const int before = column == 0 ? image.columns - 1 : column - 1;
    for (int ring = 0; ring < kNumRings; ++ring) {
      const std::int32_t here = obstacle(image, ring, column);
      if (here == RangeImage::kEmpty) continue;
      for (const int other : {ring - 1, ring + 1}) {
        if (other < 0 || other >= kNumRings) continue;
        const std::int32_t across = obstacle(image, other, before);
        if (across != RangeImage::kEmpty)
          join_if_smooth(sweep, static_cast<std::uint32_t>(here), static_cast<std::uint32_t>(across),
                         image.row_step_rad);
      }
    }
  }
}

void Clusterer::join_if_smooth(const Sweep& sweep,
                               std::uint32_t a,
                               std::uint32_t b,
                               float step_rad) noexcept {
  if (!is_smooth(point(sweep, a), point(sweep, b), step_rad)) return;
  const std::uint32_t ra = root(a), rb = root(b);
  if (ra < rb) {
    parent_[rb] = ra;
  } else {
    parent_[ra] = rb;
  }
}

// With d1 >= d2 the ranges and a the angle between the beams, the returns belong together when
// atan2(d2 sin a, d1 - d2 cos a) > join angle. Multiplied by d1: |p1 x p2| > tan(join) (d1^2 - p1 . p2).
bool Clusterer::is_smooth(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float step_rad) const noexcept {
  if (step_rad > 0.0F) {
    const float farther = std::sqrt(std::max(a.squaredNorm(), b.squaredNorm()));
    const float nearer = std::sqrt(std::min(a.squaredNorm(), b.squaredNorm()));
    const float along = farther - nearer * std::cos(step_rad);
    return along <= 0.0F || nearer * std::sin(step_rad) > static_cast<float>(tan_join_) * along;
  }
  const float along = std::max(a.squaredNorm(), b.squaredNorm()) - a.dot(b);
  return along <= 0.0F || a.cross(b).squaredNorm() > tan_join_sq_ * along * along;
}

void Clusterer::measure(const FeatureImage& image, std::uint32_t size) noexcept {
  std::fill_n(segments_.data(), size, Segment{});
  std::fill_n(label_of_.data(), size, kUnlabelled);
  for (int ring = 0; ring < kNumRings; ++ring) {
    const std::int32_t* row = image.cells.row(ring);
    for (int column = 0; column < image.columns; ++column) {
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
