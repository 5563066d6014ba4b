// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "pago/config/odometry.hpp"
#include "pago/odometry/matching.hpp"
#include "pago/registration/cell_map.hpp"

namespace pago::odometry {

/// One sweep's features by what they are used for.
struct FeatureSet {
  explicit FeatureSet(std::size_t capacity) : edges(capacity), ground(capacity), walls(capacity) {}
  PointCloud edges, ground, walls;
};

/// What a sweep is registered against: the last sweep's features, in the sensor frame at its reference
/// instant. [set-up] constructor; [estimate thread] the rest: real-time safe, deterministic.
class Targets {
 public:
  Targets(const OdometryConfig& config, std::size_t max_points);

  /// Replaces the contents: `features` moved to the reference instant by `twist`.
  void build(const FeatureSet& features, const Vector6d& twist) noexcept;

  /// The plane or line that a feature at `query` belongs to.
  std::optional<Plane> find_ground(const Eigen::Vector3d& query) noexcept;
  std::optional<Plane> find_wall(const Eigen::Vector3d& query) noexcept;
  std::optional<Line> find_edge(const Eigen::Vector3d& query) noexcept;

 private:
  /// Gaussian cells: see registration/cell_map.hpp.
  struct Cells {
    Cells(const CellTargetsConfig& config, std::size_t max_points);
    registration::CellMap planes, lines;
  };
  /// Features themselves, neighbours by ring: see matching.hpp.
  struct Rings {
    explicit Rings(std::size_t max_points)
        : deskewed(max_points), edges(max_points), ground(max_points), walls(max_points) {}
    PointCloud deskewed;
    GridIndex edges, ground, walls;
  };

  std::optional<Plane> find_plane(const Eigen::Vector3d& query, std::uint8_t surface) noexcept;

  float radius_m_;
  int per_ring_;
  std::unique_ptr<Cells> cells_;
  std::unique_ptr<Rings> rings_;
};

}  // namespace pago::odometry
