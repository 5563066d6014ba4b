// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include "pago/evaluation/scan_statistics.hpp"

namespace pago::evaluation {
namespace {

constexpr int kMostSteps = 6;  // between the returns on either side of a firing
constexpr double kReach_m = 0.2;
constexpr double kThickness_m = 0.06;
constexpr double kRingStep_rad = 0.0073;  // 26.8 degrees over 63 steps
constexpr int kSearch = 3;                // columns

struct RingReturn {
  int column;
  std::int32_t index;
  double turn_rad;  // clockwise from the rear
};

/// A sweep's returns along each ring, in the order in which they were fired.
class Rings {
 public:
  explicit Rings(const Sweep& sweep) : sweep_(sweep) {
    const auto columns = static_cast<int>(sweep.header.num_columns);
    for (int ring = 0; ring < kNumRings; ++ring)
      for (int column = 0; column < columns; ++column) {
        const std::int32_t index = sweep.range_image.at(ring, column);
        if (index == RangeImage::kEmpty) continue;
        const Eigen::Vector3d p = point(index);
        rings_[static_cast<std::size_t>(ring)].push_back(
            {column, index, std::numbers::pi - std::atan2(p.y(), p.x())});
      }
  }

  const std::vector<RingReturn>& of(int ring) const { return rings_[static_cast<std::size_t>(ring)]; }
  Eigen::Vector3d point(std::int32_t index) const {
    return Eigen::Vector3d(sweep_.x_m[static_cast<std::size_t>(index)],
                           sweep_.y_m[static_cast<std::size_t>(index)],
                           sweep_.z_m[static_cast<std::size_t>(index)]);
  }

  /// The return nearest to a cell along its ring; nothing if there is none close by.
  std::optional<Eigen::Vector3d> near(int ring, int column) const {
    const auto columns = static_cast<int>(sweep_.header.num_columns);
    if (ring < 0 || ring >= kNumRings) return std::nullopt;
    for (int aside = 0; aside <= kSearch; ++aside)
      for (const int at : {column - aside, column + aside}) {
        if (at < 0 || at >= columns) continue;
        const std::int32_t index = sweep_.range_image.at(ring, at);
        if (index != RangeImage::kEmpty) return point(index);
      }
    return std::nullopt;
  }

  /// Between firings: the median over all pairs of returns that follow one another.
  double step_rad() const {
    std::vector<float> steps;
    for (const auto& ring : rings_)
      for (std::size_t i = 1; i < ring.size(); ++i)
        steps.push_back(static_cast<float>(ring[i].turn_rad - ring[i - 1].turn_rad));
    return median_value(std::move(steps));
  }

 private:
  const Sweep& sweep_;
  std::array<std::vector<RingReturn>, kNumRings> rings_;
};

/// Cosine of the incidence on the plane that the returns `a` and `b` of a ring lie on, if they do on one.
std::optional<double> cos_incidence(
    const Rings& rings, int ring, std::size_t a, std::size_t b, double step_rad) {
  const std::vector<RingReturn>& along = rings.of(ring);
  const Eigen::Vector3d before = rings.point(along[a].index), after = rings.point(along[b].index);
  const double range_m = before.norm();
  const auto steps = static_cast<std::size_t>(std::ceil(kReach_m / (range_m * step_rad)));
  const int lines = static_cast<int>(std::ceil(kReach_m / (range_m * kRingStep_rad)));
  if (a < steps || b + steps >= along.size()) return std::nullopt;
  const RingReturn &first = along[a - steps], &last = along[b + steps];
  const auto up_first = rings.near(ring + lines, first.column),
             up_last = rings.near(ring + lines, last.column),
             down_first = rings.near(ring - lines, first.column),
             down_last = rings.near(ring - lines, last.column);
  if (!up_first || !up_last || !down_first || !down_last) return std::nullopt;
  const std::array<Eigen::Vector3d, 8> points{
      before,      after,     rings.point(first.index), rings.point(last.index), *up_first, *up_last,
      *down_first, *down_last};
  const Eigen::Vector3d normal =
      (points[3] - points[2]).cross(*up_first + *up_last - *down_first - *down_last).normalized();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  for (const Eigen::Vector3d& p : points)
    if (!(std::abs(normal.dot(p - mean)) < kThickness_m)) return std::nullopt;
  return std::abs(normal.dot((before + after).normalized()));
}

std::size_t incidence_bin(double cosine) {
  return kIncidenceBins.of(std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi);
}

/// Of the range between two others, from a straight line's.
double deviation_m(double before_m, double range_m, double after_m) {
  return std::abs(range_m - 2.0 / (1.0 / before_m + 1.0 / after_m));
}

}  // namespace

void add_surfaces(const Sweep& sweep, ScanStatistics& statistics) {
  const Rings rings(sweep);
  const double step_rad = rings.step_rad();
  if (!(step_rad > 0.0)) return;
  for (int ring = 0; ring < kNumRings; ++ring) {
    const std::vector<RingReturn>& along = rings.of(ring);
    const auto steps_between = [&](std::size_t a, std::size_t b) {
      return static_cast<int>(std::lround((along[b].turn_rad - along[a].turn_rad) / step_rad));
    };
    const auto count = [&](std::size_t a, std::size_t b) -> SurfaceCounts* {
      if (steps_between(a, b) > kMostSteps) return nullptr;
      const auto cosine = cos_incidence(rings, ring, a, b, step_rad);
      const std::size_t bin = cosine ? incidence_bin(*cosine) : kIncidenceBins.count;
      return bin < kIncidenceBins.count ? &statistics.surfaces[bin] : nullptr;
    };
    for (std::size_t i = 1; i < along.size(); ++i) {
      if (const int missing = steps_between(i - 1, i) - 1; missing > 0)
        if (SurfaceCounts* const lost = count(i - 1, i)) lost->lost += static_cast<std::uint64_t>(missing);
      if (i + 1 == along.size()) continue;
      SurfaceCounts* const had = count(i - 1, i + 1);
      if (had == nullptr) continue;
      ++had->had;
      if (steps_between(i - 1, i + 1) != 2) continue;
      const std::size_t bin = kNoiseBins.of(deviation_m(rings.point(along[i - 1].index).norm(),
                                                        rings.point(along[i].index).norm(),
                                                        rings.point(along[i + 1].index).norm()));
      if (bin < kNoiseBins.count) ++had->deviations[bin];
    }
  }
}

}  // namespace pago::evaluation
