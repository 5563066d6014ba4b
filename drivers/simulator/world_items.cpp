// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "placement.hpp"
#include "world.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

enum : std::uint64_t { kGarden = 400, kWood };

void add_lamp(Mesh& mesh, const Eigen::Isometry3d& T, Random& random) {
  const Surface metal{Material::kMetal, 128, Label::kPole};
  const double height_m = random.between(5.0, 7.5), reach_m = random.between(0.6, 1.6);
  add_bar(mesh, T * Vector3d(0, 0, -0.3), T * Vector3d(0, 0, height_m), 0.09, 0.055, 8, metal);
  add_bar(mesh, T * Vector3d(0, 0, height_m), T * Vector3d(0, reach_m, height_m + 0.15), 0.05, 0.04, 6,
          metal);
  Eigen::Isometry3d head = T;
  head.translation() = T * Vector3d(0, reach_m, height_m + 0.15);
  add_box(mesh, head, {0.25, 0.6, 0.12}, metal);
}

void add_sign(Mesh& mesh, const Eigen::Isometry3d& T, Random& random) {
  const double height_m = random.between(2.2, 2.8), size_m = random.between(0.5, 0.8);
  add_bar(mesh, T * Vector3d(0, 0, -0.3), T * Vector3d(0, 0, height_m), 0.035, 0.035, 6,
          {Material::kMetal, 128, Label::kPole});
  Eigen::Isometry3d plate = T;
  plate.translation() = T * Vector3d(0.05, 0, height_m - 0.5 * size_m);
  add_box(mesh, plate, {0.01, size_m, size_m}, {Material::kSign, 200, Label::kTrafficSign});
}

void add_bin(Mesh& mesh, Eigen::Isometry3d T, Random& random) {
  constexpr double kHeight_m = 1.05;
  T.translation().z() += 0.5 * kHeight_m;
  const auto shade = static_cast<std::uint8_t>(random.below(200));
  add_box(mesh, T, {0.6, 0.55, kHeight_m}, {Material::kMetal, shade, Label::kOtherObject});
}

}  // namespace

void World::build(Mesh& mesh, const Item& item) const {
  Random random(item.key);
  // Lamps, signs: y towards the street.
  const double to_street = heading(item.along) + (item.side > 0.0 ? std::numbers::pi : 0.0);
  const auto on_ground = [&](double yaw_rad) { return upright(item.at, ground_.height_m(item.at), yaw_rad); };
  switch (item.kind) {
    case Item::Kind::kHouse:
      return build_house(mesh, item);
    case Item::Kind::kFront:
      return build_front(mesh, item);
    case Item::Kind::kLamp:
      return add_lamp(mesh, on_ground(to_street), random);
    case Item::Kind::kSign:
      return add_sign(mesh, on_ground(to_street), random);
    case Item::Kind::kBin:
      return add_bin(mesh, on_ground(random.between(-3.1, 3.1)), random);
    case Item::Kind::kTree: {
      const Eigen::Isometry3d T = on_ground(random.between(-3.1, 3.1));
      return add_mesh(mesh, one_of(trees_, random).mesh, T, random.between(0.75, 1.1));
    }
    case Item::Kind::kParkedCar:
      return build_parked_car(mesh, item);
    case Item::Kind::kMarking:
      return build_marking(mesh, item);
    default:
      return build_roadside(mesh, item);
  }
}

void World::build_house(Mesh& mesh, const Item& item) const {
  const Town& town = scenery_.town;
  Random random(item.key);
  Plot plot = plot_of(item);
  // Built by eye.
  const Eigen::Rotation2Dd askew(random.between(-0.03, 0.03));
  plot.along = askew * plot.along;
  plot.inward = askew * plot.inward;
  plot.low_m = lowest(ground_, plot, plot.depth_m);
  add_house(mesh, plot, town.low_storeys + random.below(town.high_storeys - town.low_storeys + 1), random);
}

// In pieces of a few metres, each on its own height, as fences on slopes are.
void World::build_front(Mesh& mesh, const Item& item) const {
  Random random(item.key, 1);
  const int kind = random.below(5);
  const double height_m = kind == 4 ? random.between(1.0, 2.2) : random.between(0.8, 1.7);
  if (kind == 0) return;  // open to the street
  const Plot whole = plot_of(item);
  const int pieces = std::max(1, static_cast<int>(whole.width_m / 3.0));
  for (int i = 0; i < pieces; ++i) {
    Plot piece = whole;
    piece.width_m = whole.width_m / pieces;
    piece.corner = whole.corner + i * piece.width_m * whole.along;
    piece.low_m = lowest(ground_, piece, 0.3);
    if (kind == 1) add_wall(mesh, piece, height_m, random);
    if (kind == 2) add_picket_fence(mesh, piece, height_m);
    if (kind == 3) add_wire_fence(mesh, piece, height_m);
    if (kind == 4) add_hedge(mesh, piece, height_m, random);
  }
}

void World::build_parked_car(Mesh& mesh, const Item& item) const {
  Random random(item.key);
  const double half_wheelbase_m = 1.3;
  const double ahead = ground_.height_m(Vector2d(item.at + half_wheelbase_m * item.along));
  const double behind = ground_.height_m(Vector2d(item.at - half_wheelbase_m * item.along));
  Eigen::Isometry3d T =
      upright(item.at, 0.5 * (ahead + behind), heading(item.along) + random.between(-0.03, 0.03));
  T.rotate(Eigen::AngleAxisd(std::atan2(behind - ahead, 2.0 * half_wheelbase_m), Vector3d::UnitY()));
  if (item.side > 0.0) T.rotate(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ()));
  add_mesh(mesh, one_of(cars_, random).mesh, T, random.between(0.95, 1.05));
}

// A dash of paint, 3 m by 12 cm, as thick as paint is when it is to be seen at all.
void World::build_marking(Mesh& mesh, const Item& item) const {
  constexpr double kPaint_m = 0.004, kHalf_m = 0.06;
  const Vector2d left(-item.along.y(), item.along.x());
  const auto corner = [&](double along_m, double left_m) {
    const Vector2d at = item.at + along_m * item.along + left_m * left;
    return Vector3d(at.x(), at.y(), ground_.road_height_m(ground_.spot(at)) + kPaint_m);
  };
  for (double along_m = -1.5; along_m < 1.4; along_m += 1.0) {
    add_quad(mesh,
             {corner(along_m, -kHalf_m), corner(along_m + 1.0, -kHalf_m), corner(along_m + 1.0, kHalf_m),
              corner(along_m, kHalf_m)},
             {Material::kPaint, 180, Label::kLaneMarking});
  }
}

void World::build_gardens(Mesh& mesh, const Tile& tile) const {
  const Land& land = scenery_.land;
  constexpr int kCells = 9;  // of 7.1 m
  constexpr double kSize_m = static_cast<double>(kTile_m) / kCells;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      Random random(seed_, kGarden, tile.i * kCells + i, tile.j * kCells + j);
      const Vector2d at = tile.corner() + kSize_m * Vector2d(i + random.unit(), j + random.unit());
      const double choice = random.unit(), turn_rad = random.between(-3.1, 3.1);
      const double wood = blend(0.25, 0.45, noise(hash(seed_, kWood), at.x(), at.y(), 130.0));
      const double tree = land.tree + wood * land.wood;
      if (choice > 2.0 * tree) continue;
      const double beyond_m = ground_.streets().nearest(at).edge_m - ground_.style().sidewalk_m;
      const bool is_tree = choice < tree;
      if (beyond_m < (is_tree ? 3.0 : 1.6) || way_.nearest(at).edge_m < 2.0) continue;
      const Model& model = one_of(is_tree ? trees_ : bushes_, random);
      add_mesh(mesh, model.mesh, upright(at, ground_.height_m(at), turn_rad), random.between(0.7, 1.2));
    }
  }
}

}  // namespace pago::simulator
