// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/odometry/matching.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

namespace pago::odometry {

namespace {

constexpr int kRingReach = 2;  // LOAM: neighbours on rings up to 2.5 away
constexpr int kMostPerRing = 3;

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
    std::array<Entry, kMostPerRing> entries;
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

/// A handful of points about an origin of their own, as squares of coordinates would drown the spread.
class Spread {
 public:
  explicit Spread(const PointCloud& points, const Eigen::Vector3f& origin)
      : points_(points), origin_(origin) {}

  void add(std::uint32_t position) noexcept {
    const Eigen::Vector3d p = (points_.point(position) - origin_).cast<double>();
    ++size_;
    sum_ += p;
    sum_outer_ += p * p.transpose();
  }
  int size() const noexcept { return size_; }
  Eigen::Vector3d centre() const noexcept { return sum_ / size_ + origin_.cast<double>(); }
  /// Eigenvalues ascending: the variances along the eigenvectors.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes() const noexcept {
    const Eigen::Vector3d mean = sum_ / size_;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(sum_outer_ / size_ - mean * mean.transpose());
    return solver;
  }

 private:
  const PointCloud& points_;
  Eigen::Vector3f origin_;
  int size_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_outer_ = Eigen::Matrix3d::Zero();
};

/// The neighbours of the feature nearest to a query, by ring.
struct Neighbourhood {
  RingNeighbours neighbours;
  Spread spread;
};

template <typename Radius>
std::optional<Neighbourhood> gather(const GridIndex& target,
                                    const Eigen::Vector3f& query,
                                    float radius_m,
                                    int per_ring,
                                    Radius neighbour_radius_m) noexcept {
  const std::int32_t nearest = target.nearest(query, radius_m);
  if (nearest < 0) return std::nullopt;
  const PointCloud& points = target.points();
  const Eigen::Vector3f around = points.point(static_cast<std::size_t>(nearest));
  Neighbourhood found{RingNeighbours(points.tag[static_cast<std::size_t>(nearest)], per_ring),
                      Spread(points, around)};
  target.for_each_within(around, neighbour_radius_m(around), [&](std::uint32_t i, float distance_sq) {
    found.neighbours.offer(i, distance_sq, points.tag[i]);
  });
  return found;
}

/// Adds the nearest non-empty ring on one side of the centre; returns whether there was one.
bool add_side(const RingNeighbours& neighbours, int sign, const auto& add) noexcept {
  for (int offset = 1; offset <= kRingReach; ++offset) {
    if (neighbours.visit(sign * offset, add) > 0) return true;
  }
  return false;
}

/// How far to look for the next ring: on level ground neighbouring rings are range^2 * step / height apart.
float ring_spacing_m(const Eigen::Vector3f& point) noexcept {
  constexpr float kRingStep_rad = 0.009F, kHeight_m = 1.7F;
  return std::clamp(1.5F * point.squaredNorm() * kRingStep_rad / kHeight_m, 0.6F, 5.0F);
}

}  // namespace

std::optional<Plane> find_plane(const GridIndex& target,
                                const Eigen::Vector3f& query,
                                float radius_m,
                                int per_ring) noexcept {
  auto found = gather(target, query, radius_m, per_ring, ring_spacing_m);
  if (!found) return std::nullopt;
  auto& [neighbours, spread] = *found;
  const auto add = [&spread](std::uint32_t i) { spread.add(i); };
  neighbours.visit(0, add);
  const bool below = add_side(neighbours, -1, add), above = add_side(neighbours, +1, add);
  if ((!below && !above) || spread.size() < 3) return std::nullopt;

  const auto axes = spread.axes();
  const Eigen::Vector3d variance = axes.eigenvalues();
  constexpr double kMaxThickness_m = 0.1, kMinWidth_m = 0.03, kMaxFlatness = 0.1;
  if (!(variance[0] < kMaxThickness_m * kMaxThickness_m) || !(variance[1] > kMinWidth_m * kMinWidth_m) ||
      !(variance[0] < kMaxFlatness * variance[1])) {
    return std::nullopt;
  }
  return Plane{spread.centre(), axes.eigenvectors().col(0), std::max(0.0, variance[0])};
}

std::optional<Line> find_line(const GridIndex& target,
                              const Eigen::Vector3f& query,
                              float radius_m) noexcept {
  constexpr float kNeighbourRadius_m = 1.0F;
  auto found = gather(target, query, radius_m, 1, [](const Eigen::Vector3f&) { return kNeighbourRadius_m; });
  if (!found) return std::nullopt;
  auto& [neighbours, spread] = *found;
  for (int offset = -kRingReach; offset <= kRingReach; ++offset) {
    neighbours.visit(offset, [&spread](std::uint32_t i) { spread.add(i); });
  }
  if (spread.size() < 2) return std::nullopt;

  const auto axes = spread.axes();
  const Eigen::Vector3d variance = axes.eigenvalues();
  constexpr double kMinElongation = 3.0, kMinLength_m = 0.02;  // LeGO-LOAM's map: l1 > 3 l2
  if (!(variance[2] > kMinElongation * variance[1]) || !(variance[2] > kMinLength_m * kMinLength_m)) {
    return std::nullopt;
  }
  return Line{spread.centre(), axes.eigenvectors().col(2), std::max(0.0, variance[1])};
}

}  // namespace pago::odometry
