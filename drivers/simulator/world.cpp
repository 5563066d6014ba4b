// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "world.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pago::simulator {
namespace {

using Eigen::Vector2d;

enum : std::uint64_t { kPlot = 300, kFurniture, kParked, kModel, kSideCharacter };

constexpr int kModels = 6;  // of trees and of bushes; scaled and turned they look different enough

}  // namespace

Tile Tile::of(const Vector2d& place) noexcept {
  return {static_cast<int>(std::floor(place.x() / kTile_m)),
          static_cast<int>(std::floor(place.y() / kTile_m))};
}

World::World(Ground ground, StreetMap way, const Scenery& scenery, std::uint64_t seed)
    : ground_(std::move(ground)), way_(std::move(way)), scenery_(scenery), seed_(seed) {
  for (int i = 0; i < kModels; ++i) {
    Random random(seed, kModel, i);
    trees_.push_back(tree_model(random, random.between(5.5, 10.0), random.between(1.6, 2.6)));
    bushes_.push_back(bush_model(random, random.between(0.7, 1.6)));
    tufts_.push_back(tuft_model(random, random.between(0.3, 0.8)));
  }
  for (const CarShape shape : {CarShape::kHatchback, CarShape::kSaloon, CarShape::kVan})
    for (const std::uint8_t shade : std::array<std::uint8_t, 3>{25, 110, 230})
      cars_.push_back(car_model(shape, shade, Label::kCar));
  line_streets();
}

void World::line_streets() {
  const std::span<const StreetPoint> points = ground_.streets().points();
  for (std::size_t first = 0; first < points.size();) {
    std::size_t end = first;
    while (end < points.size() && points[end].street == points[first].street) ++end;
    const auto street = points.subspan(first, end - first);
    line_side(street, 1.0);
    line_side(street, -1.0);
    if (scenery_.is_marked) add_markings(street);
    add_structures(street);
    first = end;
  }
}

void World::line_side(std::span<const StreetPoint> street, double side) {
  add_plots(street, side);
  if (scenery_.town.has_furniture) add_furniture(street, side);
  add_parked_cars(street, side);
  add_stretches(street, side);
  add_guard_rails(street, side);
  add_verge(street, side);
}

bool World::is_free(const Vector2d& at, int street, double from_streets_m, double from_way_m) const {
  return ground_.streets().nearest_other(at, street).edge_m > from_streets_m &&
         way_.nearest(at).edge_m > from_way_m;
}

void World::put(Item item) {
  items_[Tile::of(item.at).key()].push_back(item);
}

void World::add_plots(std::span<const StreetPoint> street, double side) {
  const Town& town = scenery_.town;
  const int number = street.front().street;
  Random random(seed_, kPlot, number, side > 0.0);
  const double end_m = street.back().from_start_m;
  for (double s = 4.0; s < end_m;) {
    const double width_m = random.between(8.0, 17.0);
    const auto middle = static_cast<std::size_t>((s + 0.5 * width_m) / StreetMap::kSpacing_m);
    s += width_m;
    if (middle >= street.size() || !street[middle].is_furnished) continue;
    const StreetPoint& point = street[middle];
    // Drawn only where it matters, so that a town that is built up everywhere has the numbers to itself.
    if (town.plots < 1.0 && !random.chance(town.plots)) continue;
    const bool has_house = random.chance(town.house);
    const double setback_m =
        random.chance(town.set_back) ? random.between(2.5, 6.0) : random.between(0.0, 0.5);
    const double gap_m = random.chance(town.gap) ? random.between(1.0, 6.0) : 0.02;
    const std::uint64_t key = random.bits();
    const Vector2d outward = side * point.left();
    const double line_m = point.half_width_m + ground_.style().sidewalk_m;
    // No corner may reach into a street, the own one included where it bends.
    const auto fits = [&](double front_m, double depth_m) {
      for (const double right : {-0.5, 0.0, 0.5}) {
        for (const double in_m : {front_m, front_m + depth_m}) {
          const Vector2d corner = point.at + right * width_m * point.along + (line_m + in_m) * outward;
          if (ground_.streets().nearest(corner).edge_m < ground_.style().sidewalk_m - 0.6) return false;
        }
      }
      return true;
    };
    const bool stands_back = has_house && setback_m > 2.0;
    const auto plot = [&](Item::Kind kind, double front_m, double plot_width_m) {
      return Item{kind, point.at + (line_m + front_m) * outward, point.along, side, plot_width_m, key};
    };
    if (has_house && fits(setback_m, 9.0)) put(plot(Item::Kind::kHouse, setback_m, width_m - gap_m));
    if ((!has_house || stands_back) && fits(0.3, 1.0)) put(plot(Item::Kind::kFront, 0.3, width_m));
  }
}

void World::add_furniture(std::span<const StreetPoint> street, double side) {
  const int number = street.front().street;
  Random random(seed_, kFurniture, number, side > 0.0);
  const bool is_tree_lined = random.chance(scenery_.town.tree_lined);
  double next_lamp_m = random.between(8.0, 30.0), next_tree_m = random.between(6.0, 14.0);
  double next_sign_m = random.between(10.0, 60.0), next_bin_m = random.between(10.0, 60.0);
  for (const StreetPoint& point : street) {
    const double s = point.from_start_m;
    const auto place = [&](double& next_m, double low_m, double high_m, Item::Kind kind, double from_edge_m) {
      if (s < next_m) return;
      next_m = s + random.between(low_m, high_m);
      const Item item{.kind = kind,
                      .at = point.at + side * (point.half_width_m + from_edge_m) * point.left(),
                      .along = point.along,
                      .side = side,
                      .key = random.bits()};
      if (point.is_furnished && is_free(item.at, number, 0.4, 0.5)) put(item);
    };
    place(next_lamp_m, 24.0, 34.0, Item::Kind::kLamp, 0.5);
    if (is_tree_lined) place(next_tree_m, 8.0, 14.0, Item::Kind::kTree, 0.95);
    place(next_sign_m, 25.0, 80.0, Item::Kind::kSign, 0.4);
    place(next_bin_m, 20.0, 90.0, Item::Kind::kBin, 1.9);
  }
}

void World::add_parked_cars(std::span<const StreetPoint> street, double side) {
  constexpr std::size_t kSlot = 3;  // street points: 6 m
  const int number = street.front().street;
  Random random(seed_, kParked, number, side > 0.0);
  const double chance = scenery_.town.parked * random.between(0.2, 1.7);
  for (std::size_t i = 2; i < street.size(); i += kSlot) {
    const StreetPoint& point = street[i];
    const bool is_taken = random.chance(chance);
    const double from_edge_m = random.between(0.95, 1.15), shift_m = random.between(-0.4, 0.4);
    const std::uint64_t key = random.bits();
    if (!is_taken || !point.is_furnished) continue;
    const Item item{
        .kind = Item::Kind::kParkedCar,
        .at = point.at + side * (point.half_width_m - from_edge_m) * point.left() + shift_m * point.along,
        .along = point.along,
        .side = side,
        .key = key};
    if (is_free(item.at, number, 4.0, 1.2)) put(item);
  }
}

void World::add_markings(std::span<const StreetPoint> street) {
  for (std::size_t i = 4; i + 4 < street.size(); i += 3) {
    const StreetPoint& point = street[i];
    const Item item{.kind = Item::Kind::kMarking,
                    .at = point.at + scenery_.marking_left_m * point.left(),
                    .along = point.along};
    if (point.is_furnished && ground_.streets().nearest_other(point.at, point.street).edge_m > 1.0) put(item);
  }
}

Mesh World::tile(const Tile& tile) const {
  Mesh mesh;
  mesh.origin << tile.corner(), 0.0;
  add_ground(mesh, ground_, tile.corner(), kTile_m);
  if (const auto found = items_.find(tile.key()); found != items_.end())
    for (const Item& item : found->second) build(mesh, item);
  build_gardens(mesh, tile);
  return mesh;
}

}  // namespace pago::simulator
