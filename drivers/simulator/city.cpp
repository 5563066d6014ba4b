// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "city.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "random.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;

enum : std::uint64_t { kNode = 200, kTurn, kStop, kHill, kMissing, kWidth };

constexpr double kBlock_m = 110.0, kCrookedness_m = 14.0;
constexpr double kLane_m = 1.6;     // right of the street's middle
constexpr double kOnEdge_m = 35.0;  // the way begins this far along its first street
constexpr int kSight = 2;           // blocks to either side of the way

struct Node {
  int i = 0, j = 0;
  auto operator<=>(const Node&) const = default;
};

Vector2d place(std::uint64_t seed, Node node) {
  Random random(seed, kNode, node.i, node.j);
  return Vector2d(kBlock_m * node.i + random.between(-1, 1) * kCrookedness_m,
                  kBlock_m * node.j + random.between(-1, 1) * kCrookedness_m);
}

double hill_m(std::uint64_t seed, const Vector2d& at) {
  return 5.0 * noise(hash(seed, kHill), at.x(), at.y(), 230.0) +
         1.2 * noise(hash(seed, kHill, 1), at.x(), at.y(), 80.0);
}

std::size_t blocks_for(double length_m) {
  return static_cast<std::size_t>(length_m / (kBlock_m - 2.0 * kCrookedness_m)) + 4;
}

/// Crossings in the order in which they are passed; straight on is the most frequent.
std::vector<Node> choose_route(std::uint64_t seed, double length_m) {
  std::vector<Node> route{{0, 0}, {1, 0}};
  const std::size_t blocks = blocks_for(length_m);
  int di = 1, dj = 0;
  while (route.size() < blocks) {
    const double choice = Random(seed, kTurn, route.size()).unit();
    if (choice > 0.45) {
      const int side = choice < 0.72 ? 1 : -1;
      std::tie(di, dj) = std::pair(-dj * side, di * side);
    }
    route.push_back({route.back().i + di, route.back().j + dj});
  }
  return route;
}

/// Around a rectangle of blocks.
std::vector<Node> choose_loop(double length_m, double loop_m) {
  const int half = std::max(2, static_cast<int>(std::lround(0.5 * loop_m / kBlock_m)));
  const int wide = half / 2, high = half - wide;
  std::vector<Node> route{{0, 0}};
  const std::size_t blocks = blocks_for(length_m);
  const auto go = [&](int di, int dj, int steps) {
    for (int k = 0; k < steps; ++k) route.push_back({route.back().i + di, route.back().j + dj});
  };
  while (route.size() < blocks) {
    go(1, 0, wide);
    go(0, 1, high);
    go(-1, 0, wide);
    go(0, -1, high);
  }
  return route;
}

/// An edge of the grid by its western or southern end and its direction.
using Edge = std::pair<Node, bool>;  // true: northward

Edge edge_between(Node a, Node b) {
  return {std::min(a, b), a.i == b.i};
}

std::map<Edge, bool> choose_streets(std::uint64_t seed, const std::vector<Node>& route) {
  std::map<Edge, bool> streets;
  for (const Node& node : route) {
    for (int i = node.i - kSight; i <= node.i + kSight; ++i) {
      for (int j = node.j - kSight; j <= node.j + kSight; ++j) {
        for (const bool northward : {false, true}) {
          const bool exists = !Random(seed, kMissing, i, j, northward).chance(0.12);
          if (exists) streets[{{i, j}, northward}] = true;
        }
      }
    }
  }
  for (std::size_t k = 1; k < route.size(); ++k) streets[edge_between(route[k - 1], route[k])] = true;
  return streets;
}

void set_heights(std::uint64_t seed, std::vector<StreetPoint>& points) {
  for (StreetPoint& point : points) {
    const auto rise = [&](const Vector2d& way) {
      return 0.5 * (hill_m(seed, point.at + way) - hill_m(seed, point.at - way));
    };
    point.z_m = hill_m(seed, point.at);
    point.grade = rise(point.along);
    point.cross_grade = std::clamp(0.5 * rise(point.left()), -0.025, 0.025);
  }
}

std::vector<StreetPoint> build_streets(std::uint64_t seed, const std::map<Edge, bool>& edges) {
  std::vector<StreetPoint> all;
  int number = 0;
  for (const auto& [edge, exists] : edges) {
    const auto& [from, northward] = edge;
    const Node to{from.i + (northward ? 0 : 1), from.j + (northward ? 1 : 0)};
    const std::array line{place(seed, from), place(seed, to)};
    std::vector<StreetPoint> street = street_along(line, number++);
    const double half_width_m = Random(seed, kWidth, from.i, from.j, northward).between(5.0, 6.2);
    for (StreetPoint& point : street) point.half_width_m = half_width_m;
    set_heights(seed, street);
    all.insert(all.end(), street.begin(), street.end());
  }
  return all;
}

/// Where two lines meet, each given by a point and a direction.
Vector2d meeting_point(const Vector2d& p, const Vector2d& u, const Vector2d& q, const Vector2d& v) {
  const double cross = u.x() * v.y() - u.y() * v.x();
  if (std::abs(cross) < 1e-3) return 0.5 * (p + q);
  const Vector2d between = q - p;
  return p + u * ((between.x() * v.y() - between.y() * v.x()) / cross);
}

/// Appends the arc that turns from direction u to v, tangent to both, with its corner at `corner`.
void append_arc(const Vector2d& corner, const Vector2d& u, const Vector2d& v, std::vector<Vector2d>& way) {
  const double turn = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
  const double radius_m = std::abs(turn) > 0.6 ? (turn > 0.0 ? 10.0 : 8.0) : 45.0;
  const double trim_m = radius_m * std::tan(0.5 * std::abs(turn));
  if (trim_m < 0.05) return way.push_back(corner);
  const Vector2d inward = (turn > 0.0 ? 1.0 : -1.0) * Vector2d(-u.y(), u.x());
  const Vector2d centre = corner - trim_m * u + radius_m * inward;
  const int steps = std::max(3, static_cast<int>(radius_m * std::abs(turn) / 0.5));
  for (int k = 0; k <= steps; ++k) {
    const double angle = turn * k / steps;
    const Vector2d out = -inward;
    way.push_back(centre + radius_m * Vector2d(out.x() * std::cos(angle) - out.y() * std::sin(angle),
                                               out.x() * std::sin(angle) + out.y() * std::cos(angle)));
  }
}

}  // namespace

Route make_city(std::uint64_t seed, double length_m, double loop_m) {
  constexpr double kLeastLoop_m = 4 * kBlock_m;
  if (loop_m > 0.0 && loop_m < kLeastLoop_m)
    throw Error("simulator.loop_m", format("%g m is too short for a loop in this world", loop_m),
                format("give %g m or more, or 0 for no loop", kLeastLoop_m));
  const std::vector<Node> route = loop_m > 0.0 ? choose_loop(length_m, loop_m) : choose_route(seed, length_m);
  Route city;
  city.streets = build_streets(seed, choose_streets(seed, route));

  const auto direction = [&](std::size_t k) {
    return Vector2d((place(seed, route[k + 1]) - place(seed, route[k])).normalized());
  };
  const auto in_lane = [&](std::size_t node, const Vector2d& u) {
    return Vector2d(place(seed, route[node]) + kLane_m * Vector2d(u.y(), -u.x()));
  };
  std::vector<Vector2d> line;
  line.push_back(in_lane(0, direction(0)) + kOnEdge_m * direction(0));
  for (std::size_t k = 1; k + 1 < route.size(); ++k) {
    const Vector2d u = direction(k - 1), v = direction(k);
    if (Random(seed, kStop, k).chance(0.25)) {
      constexpr double kBefore_m = 14.0;  // from the crossing's middle, behind the stop line
      city.stops_m.push_back(Way(line).length_m() + (in_lane(k, u) - line.back()).dot(u) - kBefore_m);
    }
    append_arc(meeting_point(in_lane(k, u), u, in_lane(k, v), v), u, v, line);
  }
  city.way = Way(std::move(line));
  return city;
}

}  // namespace pago::simulator
