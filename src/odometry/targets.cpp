// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/targets.hpp"

#include "pago/core/sweep.hpp"

namespace pago::odometry {

using registration::Cell;
using registration::CellMap;
using registration::CellMapOptions;
using registration::CellShape;

namespace {

CellMapOptions planes_of(const CellTargetsConfig& c) {
  return {CellShape::kPlane, c.cell_m,          c.max_points, c.min_points,
          c.max_flatness,    c.max_thickness_m, c.min_width_m};
}
CellMapOptions lines_of(const CellTargetsConfig& c) {
  return {CellShape::kLine, c.cell_m,          c.max_points, c.min_line_points,
          c.max_flatness,   c.max_thickness_m, c.min_width_m};
}

void insert(const PointCloud& cloud, const Vector6d& twist, std::uint8_t surface, CellMap& map) noexcept {
  const Deskew to_reference(twist);
  for (std::size_t i = 0; i < cloud.size; ++i)
    map.insert(to_reference(cloud.point(i), cloud.before_s[i]).cast<double>(), surface);
}

}  // namespace

Targets::Cells::Cells(const CellTargetsConfig& config, std::size_t max_points)
    : planes(planes_of(config), static_cast<std::uint32_t>(max_points) / 4),
      lines(lines_of(config), kNumRings * 6 * 40) {}

Targets::Targets(const OdometryConfig& config, std::size_t max_points)
    : radius_m_(static_cast<float>(config.match_radius_m)), per_ring_(config.ring_neighbours) {
  if (config.targets == TargetKind::kCells) {
    cells_ = std::make_unique<Cells>(config.cells, max_points);
  } else {
    rings_ = std::make_unique<Rings>(max_points);
  }
}

void Targets::build(const FeatureSet& features, const Vector6d& twist) noexcept {
  if (cells_) {
    cells_->planes.clear();
    cells_->lines.clear();
    insert(features.ground, twist, kGround, cells_->planes);
    insert(features.walls, twist, kNonGround, cells_->planes);
    insert(features.edges, twist, kNonGround, cells_->lines);
    return;
  }
  deskew(features.edges, twist, rings_->deskewed);
  rings_->edges.build(rings_->deskewed);
  deskew(features.ground, twist, rings_->deskewed);
  rings_->ground.build(rings_->deskewed);
  deskew(features.walls, twist, rings_->deskewed);
  rings_->walls.build(rings_->deskewed);
}

std::optional<Plane> Targets::find_plane(const Eigen::Vector3d& query, std::uint8_t surface) noexcept {
  Eigen::Vector3f offset;
  const Cell* cell = cells_->planes.find_shape(query, surface, offset);
  if (cell == nullptr || !(std::abs(cell->axis.dot(offset)) < radius_m_)) return std::nullopt;
  return Plane{query - offset.cast<double>(), cell->axis.cast<double>(),
               static_cast<double>(cell->thickness_m2)};
}

std::optional<Plane> Targets::find_ground(const Eigen::Vector3d& query) noexcept {
  if (cells_) return find_plane(query, kGround);
  return odometry::find_plane(rings_->ground, query.cast<float>(), radius_m_, per_ring_);
}

std::optional<Plane> Targets::find_wall(const Eigen::Vector3d& query) noexcept {
  if (cells_) return find_plane(query, kNonGround);
  return odometry::find_plane(rings_->walls, query.cast<float>(), radius_m_, per_ring_);
}

std::optional<Line> Targets::find_edge(const Eigen::Vector3d& query) noexcept {
  if (!cells_) return find_line(rings_->edges, query.cast<float>(), radius_m_);
  Eigen::Vector3f offset;
  const Cell* cell = cells_->lines.find_shape(query, kNonGround, offset);
  if (cell == nullptr || !(cell->axis.cross(offset).norm() < radius_m_)) return std::nullopt;
  return Line{query - offset.cast<double>(), cell->axis.cast<double>(),
              static_cast<double>(cell->thickness_m2)};
}

}  // namespace pago::odometry
