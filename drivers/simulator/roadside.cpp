// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What lines a road through the country, and where it stands.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "world.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;
using Kind = Item::Kind;

enum : std::uint64_t { kStretch = 350, kRail, kGrassAt, kBridgeAt, kNiche };

constexpr std::size_t kPiece = 2;  // street points: 4 m
constexpr double kFromWay_m = 1.0;

/// What a stretch of road side has, by chance; nothing, if the parts leave room for it.
std::optional<Kind> choose(const Roadside& roadside, double choice) {
  const std::array<std::pair<double, Kind>, 5> parts{{{roadside.hedge, Kind::kHedge},
                                                      {roadside.wire_fence, Kind::kWireFence},
                                                      {roadside.tree_row, Kind::kTree},
                                                      {roadside.poles, Kind::kPole},
                                                      {roadside.noise_wall, Kind::kNoiseWall}}};
  for (const auto& [part, kind] : parts) {
    if (choice < part) return kind;
    choice -= part;
  }
  return std::nullopt;
}

/// Street points from one to the next.
std::size_t spacing(Kind kind) {
  if (kind == Kind::kTree) return 5;
  return kind == Kind::kPole ? 20 : kPiece;
}

}  // namespace

bool World::is_clear(const Vector2d& at, double from_streets_m) const {
  return ground_.streets().nearest(at).edge_m > from_streets_m && way_.nearest(at).edge_m > kFromWay_m;
}

bool World::has_median(const StreetPoint& point, double side) const {
  constexpr double kWidest_m = 8.0;
  const Vector2d edge = point.at + side * point.half_width_m * point.left();
  const StreetPlace other = ground_.streets().nearest_other(edge, point.street);
  return other.point != nullptr && other.edge_m > 1.0 && other.edge_m < kWidest_m &&
         other.point->along.dot(point.along) < -0.9;
}

void World::add_stretches(std::span<const StreetPoint> street, double side) {
  const Roadside& roadside = scenery_.roadside;
  Random random(seed_, kStretch, street.front().street, side > 0.0);
  for (std::size_t begin = 0; begin < street.size();) {
    const std::size_t end = std::min(street.size(), begin + 15 + static_cast<std::size_t>(random.below(30)));
    const std::optional<Kind> kind = choose(roadside, random.unit());
    const double from_edge_m = random.between(roadside.near_m, roadside.far_m);
    const std::uint64_t key = random.bits();
    for (std::size_t i = begin; kind && i < end; i += spacing(*kind)) {
      const StreetPoint& point = street[i];
      const Item item{.kind = *kind,
                      .at = point.at + side * (point.half_width_m + from_edge_m) * point.left(),
                      .along = point.along,
                      .side = side,
                      .width_m = 2.05 * StreetMap::kSpacing_m,
                      .key = *kind == Kind::kTree ? hash(key, i) : key};
      if (point.is_furnished && is_clear(item.at, 0.6 * from_edge_m)) put(item);
    }
    begin = end;
  }
}

void World::add_guard_rails(std::span<const StreetPoint> street, double side) {
  constexpr double kFromEdge_m = 0.8;
  const double part = scenery_.roadside.guard_rail;
  if (part <= 0.0) return;
  Random random(seed_, kRail, street.front().street, side > 0.0);
  for (std::size_t begin = 0; begin < street.size();) {
    const std::size_t end = std::min(street.size(), begin + 20 + static_cast<std::size_t>(random.below(60)));
    const bool has_rail = random.chance(part);
    for (std::size_t i = begin; i < end; i += kPiece) {
      const StreetPoint& point = street[i];
      const Item item{.kind = Kind::kGuardRail,
                      .at = point.at + side * (point.half_width_m + kFromEdge_m) * point.left(),
                      .along = point.along,
                      .side = side};
      if (!has_rail && !has_median(point, side)) continue;
      if (point.is_furnished && is_clear(item.at, 0.5 * kFromEdge_m)) put(item);
    }
    begin = end;
  }
}

/// Delineators and tall grass.
void World::add_verge(std::span<const StreetPoint> street, double side) {
  const Roadside& roadside = scenery_.roadside;
  Random random(seed_, kGrassAt, street.front().street, side > 0.0);
  double next_post_m = 0.5 * roadside.post_every_m;
  for (const StreetPoint& point : street) {
    const auto place = [&](Kind kind, double from_edge_m) {
      const Item item{.kind = kind,
                      .at = point.at + side * (point.half_width_m + from_edge_m) * point.left(),
                      .along = point.along,
                      .side = side,
                      .key = random.bits()};
      if (point.is_furnished && is_clear(item.at, 0.3)) put(item);
    };
    if (random.chance(roadside.tall_grass)) place(Kind::kTallGrass, random.between(0.5, 3.5));
    if (roadside.post_every_m <= 0.0 || point.from_start_m < next_post_m) continue;
    next_post_m += roadside.post_every_m;
    place(Kind::kDelineator, 0.6);
  }
}

/// Bridges across the road, and the tunnel around it.
void World::add_structures(std::span<const StreetPoint> street) {
  const Roadside& roadside = scenery_.roadside;
  const int number = street.front().street;
  Random random(seed_, kBridgeAt, number);
  double next_m = random.between(0.2, 0.6) * roadside.bridge_every_m;
  for (const StreetPoint& point : street) {
    Item item{.at = point.at, .along = point.along, .width_m = point.half_width_m};
    if (roadside.is_tunnel) {
      item.kind = Kind::kTunnel;
      item.key = hash(seed_, kNiche, number, std::lround(point.from_start_m));
      if (point.is_furnished) put(item);
    }
    if (roadside.bridge_every_m <= 0.0 || point.from_start_m < next_m) continue;
    // A dual carriageway is bridged from one of them.
    if (number % 2 == 1 && has_median(point, 1.0)) continue;
    next_m = point.from_start_m + random.between(0.6, 1.4) * roadside.bridge_every_m;
    item.kind = Kind::kBridge;
    item.key = random.bits();
    if (point.is_furnished) put(item);
  }
}

}  // namespace pago::simulator
