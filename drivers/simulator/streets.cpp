// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "streets.hpp"

#include <algorithm>
#include <cmath>

namespace pago::simulator {

StreetMap::StreetMap(std::vector<StreetPoint> points) : points_(std::move(points)) {
  constexpr double kHalfDiagonal = kCell_m * 0.7072;
  constexpr int kCells = static_cast<int>((kReach_m + kHalfDiagonal) / kCell_m) + 1;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d corner = (points_[i].at / kCell_m).array().floor().matrix();
    for (int dy = -kCells; dy <= kCells; ++dy) {
      for (int dx = -kCells; dx <= kCells; ++dx) {
        const Eigen::Vector2d centre = (corner + Eigen::Vector2d(dx + 0.5, dy + 0.5)) * kCell_m;
        if ((centre - points_[i].at).norm() < kReach_m + kHalfDiagonal) cells_[cell_of(centre)].push_back(i);
      }
    }
  }
}

std::uint64_t StreetMap::cell_of(const Eigen::Vector2d& place) noexcept {
  const auto x = static_cast<std::int32_t>(std::floor(place.x() / kCell_m));
  const auto y = static_cast<std::int32_t>(std::floor(place.y() / kCell_m));
  return std::uint64_t{static_cast<std::uint32_t>(x)} << 32U | static_cast<std::uint32_t>(y);
}

std::span<const std::uint32_t> StreetMap::around(const Eigen::Vector2d& place) const noexcept {
  const auto found = cells_.find(cell_of(place));
  if (found == cells_.end()) return {};
  return found->second;
}

StreetPlace StreetMap::relate(const StreetPoint& point, const Eigen::Vector2d& place) noexcept {
  const Eigen::Vector2d from = place - point.at;
  StreetPlace result{&point, 0.0, point.along.dot(from), point.left().dot(from)};
  const double beyond = std::max(0.0, std::abs(result.along_m) - 0.5 * kSpacing_m);
  result.edge_m = std::sqrt(beyond * beyond + result.offset_m * result.offset_m) - point.half_width_m;
  return result;
}

StreetPlace StreetMap::nearest(const Eigen::Vector2d& place) const noexcept {
  return nearest_other(place, -1);
}

StreetPlace StreetMap::nearest_other(const Eigen::Vector2d& place, int street) const noexcept {
  StreetPlace best;
  best.edge_m = kReach_m;
  for (const std::uint32_t i : around(place)) {
    if (points_[i].street == street) continue;
    const StreetPlace candidate = relate(points_[i], place);
    if (candidate.edge_m < best.edge_m) best = candidate;
  }
  return best;
}

std::vector<StreetPoint> street_along(std::span<const Eigen::Vector2d> line, int street) {
  std::vector<double> length(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) length[i] = length[i - 1] + (line[i] - line[i - 1]).norm();
  const auto count = static_cast<std::size_t>(length.back() / StreetMap::kSpacing_m) + 1;
  std::vector<StreetPoint> points(count);
  std::size_t next = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) * StreetMap::kSpacing_m;
    while (next + 1 < line.size() && length[next] < s) ++next;
    const double share = (s - length[next - 1]) / std::max(1e-9, length[next] - length[next - 1]);
    points[k].at = line[next - 1] + share * (line[next] - line[next - 1]);
    points[k].from_start_m = s;
    points[k].street = street;
  }
  for (std::size_t k = 0; k < count && count > 1; ++k) {
    const std::size_t before = k > 0 ? k - 1 : 0, after = std::min(k + 1, count - 1);
    points[k].along = (points[after].at - points[before].at).normalized();
  }
  return points;
}

}  // namespace pago::simulator
