// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pago/core/range_image.hpp"
#include "pago/registration/kd_tree.hpp"

namespace pago::odometry {

/// One sweep's features of a kind, row by row of the range image: row r is [begin[r], begin[r + 1]).
struct RowCloud {
  std::vector<Eigen::Vector3f> points;
  std::array<std::uint32_t, kNumRings + 1> begin{};
};

/// Where a feature lies off what it was matched with: `normal` is the direction in which the distance grows.
struct Offset {
  Eigen::Vector3d normal;
  double distance_m;
};

/// Neighbours as LOAM's and LeGO-LOAM's code finds them: the nearest feature within a radius; for a line the
/// nearest of those on other rows, for a plane the nearest other one on its own row and the nearest on other
/// rows; at most two rows away, within the radius of the query. Allocates while it is built; deterministic.
/// [one thread]
class LoamTargets {
 public:
  explicit LoamTargets(double radius_m) : radius_sq_m2_(static_cast<float>(radius_m * radius_m)) {}

  void build(RowCloud cloud);
  const RowCloud& cloud() const noexcept { return cloud_; }

  std::optional<std::array<std::uint32_t, 2>> find_line(const Eigen::Vector3f& query) const;
  std::optional<std::array<std::uint32_t, 3>> find_plane(const Eigen::Vector3f& query) const;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::uint32_t find_nearest(const Eigen::Vector3f& query) const;
  std::uint32_t row_of(std::uint32_t i) const noexcept;
  /// The nearest to `query` of [from, until) but `except`.
  void consider(std::uint32_t from,
                std::uint32_t until,
                std::uint32_t except,
                const Eigen::Vector3f& query,
                float& least_sq_m2,
                std::uint32_t& best) const noexcept;
  std::uint32_t nearest_on_other_rows(std::uint32_t row, const Eigen::Vector3f& query) const noexcept;

  float radius_sq_m2_;
  RowCloud cloud_;
  registration::KdTree tree_;
};

/// From the line through a and b; no direction for a point on it, or where both are one.
std::optional<Offset> offset_from_line(const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b) noexcept;
/// From the plane through a, b and c; nothing where they lie on a line.
std::optional<Offset> offset_from_plane(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c) noexcept;

}  // namespace pago::odometry
