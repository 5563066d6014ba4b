// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace pago::simulator {

/// A point on the middle of a carriageway.
struct StreetPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit vector
  double z_m = 0.0;
  double grade = 0.0, cross_grade = 0.0;  ///< rise per metre along the street, and to its left
  double half_width_m = 5.0;
  double from_start_m = 0.0;
  int street = 0;
  bool is_furnished = true;  ///< false where another pass along the same way has brought what lines it

  Eigen::Vector2d left() const { return {-along.y(), along.x()}; }
};

/// Where a place in the plane lies, seen from the nearest street.
struct StreetPlace {
  const StreetPoint* point = nullptr;    ///< null: no street within StreetMap::kReach_m
  double edge_m = 0.0;                   ///< distance from the carriageway's edge; negative on it
  double along_m = 0.0, offset_m = 0.0;  ///< from the point: along the street, and to its left
};

/// All streets of a world. [set-up] the constructor; [any thread] the rest.
class StreetMap {
 public:
  static constexpr double kSpacing_m = 2.0;  ///< between the points of a street
  static constexpr double kReach_m = 50.0;

  StreetMap() = default;
  explicit StreetMap(std::vector<StreetPoint> points);

  std::span<const StreetPoint> points() const noexcept { return points_; }
  /// Indices of all points within kReach_m of a place, and some more.
  std::span<const std::uint32_t> around(const Eigen::Vector2d& place) const noexcept;

  /// The street whose carriageway is nearest, or whose middle is, where it is on several.
  StreetPlace nearest(const Eigen::Vector2d& place) const noexcept;
  /// The same among streets other than this one.
  StreetPlace nearest_other(const Eigen::Vector2d& place, int street) const noexcept;

  /// How a place lies to one point of a street.
  static StreetPlace relate(const StreetPoint& point, const Eigen::Vector2d& place) noexcept;

 private:
  static constexpr double kCell_m = 16.0;
  static std::uint64_t cell_of(const Eigen::Vector2d& place) noexcept;

  std::vector<StreetPoint> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// A line resampled at StreetMap::kSpacing_m, with directions; heights and widths are left to the caller.
std::vector<StreetPoint> street_along(std::span<const Eigen::Vector2d> line, int street);

}  // namespace pago::simulator
