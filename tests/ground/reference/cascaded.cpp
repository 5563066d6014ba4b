// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "src/ground/random.hpp"
#include "tests/ground/reference/points.hpp"

namespace pago::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kBeams = 64, kColumns = 2083;

double below_horizon_deg(int beam) {
  return beam < 32 ? -2.0 + beam / 3.0 : 8.83 + (beam - 32) / 2.0;
}

/// From the top; nothing for what no beam looks at.
std::optional<int> beam_of(const Point& point) {
  const double angle = std::atan2(point.p.z(), point.range()) / kDegree;
  const double beam = angle >= -8.83 ? (2.0 - angle) * 3.0 + 0.5 : 32.0 + (-8.83 - angle) * 2.0 + 0.5;
  if (!(beam > -1.0 && beam < kBeams)) return std::nullopt;
  return static_cast<int>(beam);
}

/// Range at which a beam meets ground that rises by `slope`, for a sensor one metre up.
double reach(int beam, double slope_deg) {
  return 1.0 / (std::tan(below_horizon_deg(beam) * kDegree) + std::tan(slope_deg * kDegree));
}

/// Points of a column's chains that are obstacles. `column`: beam -> point.
PointList obstacles_in(const std::map<int, Point>& column, double h, const CascadedConfig& c) {
  PointList obstacles, chain;
  int before = 0;
  const auto close_chain = [&] {
    if (chain.empty()) return;
    const auto [low, high] =
        std::ranges::minmax_element(chain, {}, [](const Point& point) { return point.p.z(); });
    if (chain.size() > 1 && high->p.z() - low->p.z() > c.max_upright_m)
      obstacles.insert(obstacles.end(), chain.begin(), chain.end());
    chain.clear();
  };
  for (auto it = column.rbegin(); it != column.rend(); ++it) {  // from the lowest beam up
    double spacing = 0.0;
    for (int beam = before; beam > it->first; --beam)
      spacing += h * std::abs(reach(beam - 1, c.max_slope_deg) - reach(beam, c.max_slope_deg));
    if (!chain.empty() && !(std::abs(chain.back().range() - it->second.range()) < spacing)) close_chain();
    chain.push_back(it->second);
    before = it->first;
  }
  close_chain();
  return obstacles;
}

int quadrant_of(const Point& point) {
  const double degrees = point.azimuth() / kDegree;
  return degrees < 45.0 || degrees >= 315.0 ? 0 : degrees < 135.0 ? 1 : degrees < 225.0 ? 2 : 3;
}

double height_at(const Plane& plane, double x, double y) {
  return plane.mean.z() -
         (plane.normal.x() * (x - plane.mean.x()) + plane.normal.y() * (y - plane.mean.y())) /
             plane.normal.z();
}

bool continues(
    const Plane& before, const Plane& plane, double border_m, int quadrant, const CascadedConfig& c) {
  const double x = border_m * std::cos(quadrant * 90.0 * kDegree);
  const double y = border_m * std::sin(quadrant * 90.0 * kDegree);
  const double angle_deg = std::acos(std::min(1.0, plane.normal.dot(before.normal))) / kDegree;
  return std::abs(height_at(plane, x, y) - height_at(before, x, y)) <= c.max_height_step_m &&
         angle_deg <= c.max_angle_deg;
}

}  // namespace

Reference cascaded_reference(const CascadedConfig& c, const Mount& mount) {
  return [c, mount](const Sweep& sweep) {
    PointList points;
    std::map<int, std::map<int, Point>> columns;
    for (const Point& point : returns_of(sweep, mount)) {
      const std::optional<int> beam = beam_of(point);
      if (!beam || !(point.range() > c.min_range_m && point.range() < c.max_range_m)) continue;
      points.push_back(point);
      const int column = static_cast<int>(kColumns * point.azimuth() / (2.0 * std::numbers::pi));
      columns[column].insert_or_assign(*beam, point);
    }
    std::set<std::size_t> obstacles;
    for (const auto& [number, column] : columns)
      for (const Point& point : obstacles_in(column, mount.height_m, c)) obstacles.insert(point.index);

    std::vector<double> bounds;
    const int width = static_cast<int>(std::ceil(static_cast<double>(kBeams) / c.sections));
    for (int s = 1; s < c.sections; ++s)
      bounds.push_back(mount.height_m / std::tan(below_horizon_deg(kBeams - width * s) * kDegree));
    std::map<std::pair<int, int>, PointList> regions;
    for (const Point& point : points) {
      int section = 0;
      for (const double bound : bounds) section += point.range() >= bound ? 1 : 0;
      if (!obstacles.contains(point.index)) regions[{quadrant_of(point), section}].push_back(point);
    }
    Mask mask = empty_mask(sweep);
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      Plane before;
      for (int section = 0; section < c.sections; ++section) {
        const PointList& region = regions[{quadrant, section}];
        Plane plane;
        if (region.size() > 3)
          plane = ransac(region, c.inlier_distance_m, c.max_iterations, c.confidence, 0.0,
                         ground::scramble(static_cast<std::uint64_t>(c.seed)) +
                             static_cast<std::uint64_t>(4 * quadrant + section));
        const bool is_first = !before.is_valid;
        if (!plane.is_valid ||
            !(is_first ||
              continues(before, plane, bounds[static_cast<std::size_t>(section) - 1], quadrant, c)))
          plane = before;
        for (const Point& point : region)
          if (plane.is_valid && std::abs(plane.above(point.p)) < c.inlier_distance_m)
            mask[point.index] = kGround;
        before = plane;
      }
    }
    return mask;
  };
}

}  // namespace pago::test
