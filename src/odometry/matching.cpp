// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/matching.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

namespace pago::odometry {

namespace {

constexpr int kRingReach = 2;  // LOAM: neighbours on rings up to 2.5 away
constexpr int kPerRing = 3;

/// The few nearest features of each ring around a centre ring, nearest first.
class RingNeighbours {
 public:
  explicit RingNeighbours(int centre_ring, int per_ring) : centre_(centre_ring), per_ring_(per_ring) {}

  void offer(std::uint32_t position, float distance_sq, int ring) noexcept {
    const int offset = ring - centre_;
    if (offset < -kRingReach || offset > kRingReach) return;
    auto& row = rows_[static_cast<std::size_t>(offset + kRingReach)];
    if (row.size == per_ring_ && !is_before(distance_sq, position, row.entries[at(row.size - 1)])) return;
    int place = row.size < per_ring_ ? row.size++ : row.size - 1;
    for (; place > 0 && is_before(distance_sq, position, row.entries[at(place - 1)]); --place) {
      row.entries[at(place)] = row.entries[at(place - 1)];
    }
    row.entries[at(place)] = {position, distance_sq};
  }

  /// Visits the positions held for ring `centre + offset`; returns how many there are.
  template <typename Visit>
  int visit(int offset, Visit visit) const noexcept {
    const auto& row = rows_[static_cast<std::size_t>(offset + kRingReach)];
    for (int i = 0; i < row.size; ++i) visit(row.entries[at(i)].position);
    return row.size;
  }

 private:
  struct Entry {
    std::uint32_t position;
    float distance_sq;
  };
  struct Row {
    std::array<Entry, kPerRing> entries;
    int size = 0;
  };
  static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  // Ties go to the earlier feature, so that the outcome does not depend on the order of visits.
  static bool is_before(float distance_sq, std::uint32_t position, const Entry& entry) noexcept {
    return distance_sq < entry.distance_sq || (distance_sq == entry.distance_sq && position < entry.position);
  }

  int centre_, per_ring_;
  std::array<Row, 2 * kRingReach + 1> rows_{};
};

/// Mean and scatter of a handful of points.
struct Scatter {
  int n = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_outer = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) noexcept {
    ++n;
    sum += p;
    sum_outer += p * p.transpose();
  }
  Eigen::Matrix3d covariance(const Eigen::Vector3d& mean) const noexcept {
    return sum_outer / n - mean * mean.transpose();
  }
};

/// Adds the nearest non-empty ring on one side of the centre; returns whether there was one.
bool add_side(const RingNeighbours& neighbours, int sign, const auto& add) noexcept {
  for (int offset = 1; offset <= kRingReach; ++offset) {
    if (neighbours.visit(sign * offset, add) > 0) return true;
  }
  return false;
}

/// Rings fan out with the range: on level ground neighbouring rings are range^2 * step / height apart.
float neighbour_radius_m(const Eigen::Vector3f& point) noexcept {
  constexpr float kRingStep_rad = 0.009F, kHeight_m = 1.7F;
  return std::clamp(1.5F * point.squaredNorm() * kRingStep_rad / kHeight_m, 0.6F, 5.0F);
}

}  // namespace

std::optional<Plane> find_plane(const GridIndex& target,
                                const Eigen::Vector3f& query,
                                float radius_m) noexcept {
  const std::int32_t nearest = target.nearest(query, radius_m);
  if (nearest < 0) return std::nullopt;
  const auto& points = target.points();
  const Eigen::Vector3f around = points.point(static_cast<std::size_t>(nearest));
  RingNeighbours neighbours(points.ring[static_cast<std::size_t>(nearest)], kPerRing);
  target.for_each_within(around, neighbour_radius_m(around), [&](std::uint32_t i, float distance_sq) {
    neighbours.offer(i, distance_sq, points.ring[i]);
  });

  Scatter scatter;
  // About the nearest feature, as squares of coordinates would drown the spread.
  const auto add = [&](std::uint32_t i) { scatter.add((points.point(i) - around).cast<double>()); };
  neighbours.visit(0, add);
  const bool below = add_side(neighbours, -1, add), above = add_side(neighbours, +1, add);
  if ((!below && !above) || scatter.n < 3) return std::nullopt;

  const Eigen::Vector3d mean = scatter.sum / scatter.n;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scatter.covariance(mean));
  const Eigen::Vector3d spread = eigen.eigenvalues();
  constexpr double kMaxThickness_m = 0.1, kMinWidth_m = 0.03, kMaxFlatness = 0.1;
  if (!(spread[0] < kMaxThickness_m * kMaxThickness_m) || !(spread[1] > kMinWidth_m * kMinWidth_m) ||
      !(spread[0] < kMaxFlatness * spread[1])) {
    return std::nullopt;
  }
  return Plane{mean + around.cast<double>(), eigen.eigenvectors().col(0)};
}

std::optional<Line> find_line(const GridIndex& target,
                              const Eigen::Vector3f& query,
                              float radius_m) noexcept {
  const std::int32_t nearest = target.nearest(query, radius_m);
  if (nearest < 0) return std::nullopt;
  const auto& points = target.points();
  const Eigen::Vector3f around = points.point(static_cast<std::size_t>(nearest));
  RingNeighbours neighbours(points.ring[static_cast<std::size_t>(nearest)], 1);
  constexpr float kNeighbourRadius_m = 1.0F;
  target.for_each_within(around, kNeighbourRadius_m, [&](std::uint32_t i, float distance_sq) {
    neighbours.offer(i, distance_sq, points.ring[i]);
  });

  Scatter scatter;
  const auto add = [&](std::uint32_t i) { scatter.add((points.point(i) - around).cast<double>()); };
  for (int offset = -kRingReach; offset <= kRingReach; ++offset) neighbours.visit(offset, add);
  if (scatter.n < 2) return std::nullopt;

  const Eigen::Vector3d mean = scatter.sum / scatter.n;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scatter.covariance(mean));
  const Eigen::Vector3d spread = eigen.eigenvalues();
  constexpr double kMinElongation = 3.0, kMinLength_m = 0.02;  // LeGO-LOAM's map: l1 > 3 l2
  if (!(spread[2] > kMinElongation * spread[1]) || !(spread[2] > kMinLength_m * kMinLength_m))
    return std::nullopt;
  return Line{mean + around.cast<double>(), eigen.eigenvectors().col(2)};
}

}  // namespace pago::odometry
