// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "road.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "random.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;

enum : std::uint64_t { kSweep = 1000, kBend, kHills, kRipples, kRoadStop };

constexpr double kStep_m = 0.5;
constexpr double kPastEnds_m = 160.0;

double waves(const Waves& shape, std::uint64_t key, const Vector2d& at) {
  return shape.amplitude * noise(key, at.x(), at.y(), shape.size_m);
}

double height_m(const RoadShape& shape, std::uint64_t seed, const Vector2d& at) {
  return waves(shape.hills, hash(seed, kHills), at) + waves(shape.ripples, hash(seed, kRipples), at);
}

/// From a place on a line or circle as long as the road, on which headings are laid out.
double heading_at(const RoadShape& shape, std::uint64_t seed, const Vector2d& place) {
  return waves(shape.sweep, hash(seed, kSweep), place) + waves(shape.bend, hash(seed, kBend), place);
}

/// The road's middle, from kPastEnds_m before its beginning.
std::vector<Vector2d> open_line(const RoadShape& shape, std::uint64_t seed, double length_m) {
  std::vector<Vector2d> line{Vector2d(-kPastEnds_m, 0.0)};
  for (double s = -kPastEnds_m; s < length_m + kPastEnds_m; s += kStep_m) {
    const double angle = heading_at(shape, seed, {s, 0.0});
    line.push_back(line.back() + kStep_m * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return line;
}

/// Once around; the last point is the first.
std::vector<Vector2d> closed_line(const RoadShape& shape, std::uint64_t seed, double loop_m) {
  const auto steps = static_cast<int>(std::lround(loop_m / kStep_m));
  const double radius_m = loop_m / (2.0 * std::numbers::pi);
  std::vector<Vector2d> line{Vector2d::Zero()};
  for (int k = 0; k < steps; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / steps;
    const double angle = turn + heading_at(shape, seed, radius_m * Vector2d(std::cos(turn), std::sin(turn)));
    line.push_back(line.back() + kStep_m * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const Vector2d gap = line.back();
  for (int k = 0; k <= steps; ++k) line[static_cast<std::size_t>(k)] -= gap * k / steps;
  return line;
}

/// A line beside another; a closed one stays closed.
std::vector<Vector2d> beside(const std::vector<Vector2d>& line, double right_m) {
  const bool is_closed = (line.front() - line.back()).norm() < 1e-6;
  std::vector<Vector2d> result;
  const std::size_t last = line.size() - 1;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d& before = i > 0 ? line[i - 1] : line[is_closed ? last - 1 : 0];
    const Vector2d& after = i < last ? line[i + 1] : line[is_closed ? 1 : last];
    const Vector2d along = (after - before).normalized();
    result.push_back(line[i] + right_m * Vector2d(along.y(), -along.x()));
  }
  return result;
}

void add_carriageway(const RoadShape& shape,
                     std::uint64_t seed,
                     const std::vector<Vector2d>& line,
                     int number,
                     std::vector<StreetPoint>& streets) {
  for (StreetPoint& point : street_along(line, number)) {
    const auto rise = [&](const Vector2d& way) {
      return 0.5 * (height_m(shape, seed, point.at + way) - height_m(shape, seed, point.at - way));
    };
    point.half_width_m = shape.half_width_m;
    point.z_m = height_m(shape, seed, point.at);
    point.grade = rise(point.along);
    point.cross_grade = std::clamp(0.5 * rise(point.left()), -0.03, 0.03);
    streets.push_back(point);
  }
}

std::vector<double> choose_stops(const RoadShape& shape, std::uint64_t seed, double length_m) {
  constexpr double kSlot_m = 200.0;
  std::vector<double> stops_m;
  for (int slot = 0; slot * kSlot_m < length_m; ++slot) {
    Random random(seed, kRoadStop, slot);
    const bool stops = random.chance(shape.stops_per_km * kSlot_m / 1000.0);
    if (stops) stops_m.push_back(kSlot_m * (slot + random.unit()));
  }
  return stops_m;
}

}  // namespace

Route make_road(const RoadShape& shape, std::uint64_t seed, double length_m, double loop_m) {
  if (loop_m > 0.0 && loop_m < shape.least_loop_m)
    throw Error("simulator.loop_m", format("%g m is too short for a loop in this world", loop_m),
                format("give %g m or more, or 0 for no loop", shape.least_loop_m));
  const std::vector<Vector2d> middle =
      loop_m > 0.0 ? closed_line(shape, seed, loop_m) : open_line(shape, seed, length_m);
  const double right_m = carriageway_right_m(shape);
  Route route;
  add_carriageway(shape, seed, beside(middle, right_m), 0, route.streets);
  if (shape.median_m > 0.0) {
    std::vector<Vector2d> oncoming = beside(middle, -right_m);
    std::ranges::reverse(oncoming);
    add_carriageway(shape, seed, oncoming, 1, route.streets);
  }
  const std::vector<Vector2d> lane = beside(middle, right_m + shape.lane_m);
  std::vector<Vector2d> way;
  const auto before = static_cast<std::ptrdiff_t>(kPastEnds_m / kStep_m);
  if (loop_m > 0.0) {
    for (double s = 0.0; s < length_m + loop_m; s += loop_m)
      way.insert(way.end(), lane.begin(), lane.end() - 1);
  } else {
    way.assign(lane.begin() + before, lane.end() - before);
  }
  route.way = Way(std::move(way));
  route.stops_m = choose_stops(shape, seed, route.way.length_m());
  return route;
}

}  // namespace pago::simulator
