// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What lines a road through the country, and what it looks like.
#include <algorithm>
#include <array>
#include <cmath>

#include "placement.hpp"
#include "world.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = Item::Kind;

void add_power_pole(Mesh& mesh, const Eigen::Isometry3d& T) {
  const Surface wood{Material::kWood, 90, Label::kPole};
  add_bar(mesh, T * Vector3d(0, 0, -0.5), T * Vector3d(0, 0, 8.5), 0.15, 0.11, 8, wood);
  add_bar(mesh, T * Vector3d(0, -0.9, 7.9), T * Vector3d(0, 0.9, 7.9), 0.06, 0.06, 4, wood);
}

void add_delineator(Mesh& mesh, Eigen::Isometry3d T) {
  T.translation().z() += 0.5;
  add_box(mesh, T, {0.08, 0.12, 1.1}, {Material::kPaint, 200, Label::kPole});
  T.translation() += T.linear() * Vector3d(0.0, 0.0, 0.3);
  add_box(mesh, T, {0.09, 0.05, 0.16}, {Material::kSign, 150, Label::kPole});
}

}  // namespace

void World::build_roadside(Mesh& mesh, const Item& item) const {
  Random random(item.key);
  const Eigen::Isometry3d T = upright(item.at, ground_.height_m(item.at), heading(item.along));
  switch (item.kind) {
    case Kind::kGuardRail:
      return build_guard_rail(mesh, item);
    case Kind::kPole:
      return add_power_pole(mesh, T);
    case Kind::kDelineator:
      return add_delineator(mesh, T);
    case Kind::kTallGrass:
      return add_mesh(mesh, one_of(tufts_, random).mesh, T, random.between(0.8, 1.3));
    case Kind::kBridge:
      return build_bridge(mesh, item);
    case Kind::kTunnel:
      return build_tunnel(mesh, item);
    default:
      return build_barrier(mesh, item);
  }
}

// A piece of a hedge, a fence or a noise wall: as high as its neighbours, each on its own ground.
void World::build_barrier(Mesh& mesh, const Item& item) const {
  Random same(item.key), own(item.key, std::lround(10.0 * item.at.x()), std::lround(10.0 * item.at.y()));
  const double height_m = same.between(0.9, 1.9);
  Plot piece = plot_of(item);
  piece.low_m = lowest(ground_, piece, 0.3);
  if (item.kind == Kind::kHedge) add_hedge(mesh, piece, height_m, own);
  if (item.kind == Kind::kWireFence) add_wire_fence(mesh, piece, height_m);
  if (item.kind == Kind::kNoiseWall) add_wall(mesh, piece, 1.5 + height_m, same);
}

// A beam of W section, 31 cm high, its middle 60 cm above the ground, on posts every 4 m.
void World::build_guard_rail(Mesh& mesh, const Item& item) const {
  const Surface steel{Material::kMetal, 170, Label::kFence};
  const double half_m = 1.02 * StreetMap::kSpacing_m;
  const Vector2d outward = item.side * Vector2d(-item.along.y(), item.along.x());
  const auto at = [&](double along_m, double out_m, double up_m) {
    const Vector2d foot = item.at + along_m * item.along;
    const Vector2d p = foot + out_m * outward;
    return Vector3d(p.x(), p.y(), ground_.height_m(foot) + up_m);
  };
  constexpr std::array<std::array<double, 2>, 5> kSection{
      {{0.08, 0.445}, {0.0, 0.52}, {0.08, 0.6}, {0.0, 0.68}, {0.08, 0.755}}};
  for (std::size_t k = 1; k < kSection.size(); ++k) {
    const auto &a = kSection[k - 1], &b = kSection[k];
    add_quad(
        mesh,
        {at(-half_m, a[0], a[1]), at(half_m, a[0], a[1]), at(half_m, b[0], b[1]), at(-half_m, b[0], b[1])},
        steel);
  }
  add_bar(mesh, at(0.0, 0.14, -0.3), at(0.0, 0.14, 0.75), 0.05, 0.05, 5, steel);
}

// A road across: its deck, pillars beside the carriageways, and what carries its ends.
void World::build_bridge(Mesh& mesh, const Item& item) const {
  Random random(item.key);
  const Surface concrete{Material::kConcrete, 140, Label::kOtherStructure};
  const StreetPlace here = ground_.streets().nearest(item.at);
  const StreetPlace other = ground_.streets().nearest_other(
      item.at + item.width_m * Vector2d(-item.along.y(), item.along.x()), here.point->street);
  const bool is_dual = other.point != nullptr && other.edge_m < 8.0;
  const double median_m = is_dual ? other.edge_m : 0.0;
  // To the left, from the carriageway's middle: the bridge's middle, and where its ends rest.
  const double middle_m = is_dual ? item.width_m + 0.5 * median_m : 0.0;
  const double half_m =
      (is_dual ? 0.5 * median_m + 2.0 * item.width_m : item.width_m) + random.between(3.0, 6.0);
  const double low_m = ground_.height_m(item.at) + random.between(4.9, 5.6),
               width_m = random.between(7.0, 11.0);
  Eigen::Isometry3d T = upright(item.at, 0.0, heading(item.along));
  const auto box = [&](double left_m, double z_m, const Vector3d& size) {
    Eigen::Isometry3d T_box = T;
    T_box.translation() = T * Vector3d(0.0, left_m, z_m);
    if (way_.nearest(T_box.translation().head<2>()).edge_m > 1.0 || z_m > low_m)
      add_box(mesh, T_box, size, concrete);
  };
  box(middle_m, low_m + 0.6, {width_m, 2.0 * half_m + 20.0, 1.2});
  for (const double side : {-1.0, 1.0})
    box(middle_m + side * (half_m + 1.0), low_m - 3.5, {width_m, 2.0, 7.2});
  if (is_dual) box(middle_m, low_m - 3.5, {width_m - 2.0, 0.8, 7.2});
}

// A ring of concrete, 2 m of it. Here and there a door is set back into the wall.
void World::build_tunnel(Mesh& mesh, const Item& item) const {
  constexpr double kWalkway_m = 1.0, kDoor = 0.025, kDoorDeep_m = 0.7;
  constexpr std::array<std::array<double, 2>, 5> kSection{
      {{1.0, -0.3}, {1.0, 3.6}, {0.75, 5.3}, {0.35, 6.2}, {0.0, 6.4}}};
  Random random(item.key);
  const Surface concrete{Material::kConcrete, 150, Label::kOtherStructure};
  const Surface metal{Material::kMetal, 110, Label::kOtherStructure};
  const double wide_m = item.width_m + kWalkway_m, half_m = 0.502 * StreetMap::kSpacing_m;
  const Vector2d left(-item.along.y(), item.along.x());
  for (const double side : {-1.0, 1.0}) {
    const bool has_door = random.chance(kDoor);
    const auto at = [&](double along_m, double out_m, double up_m) {
      const Vector2d middle = item.at + along_m * item.along, p = middle + side * out_m * left;
      return Vector3d(p.x(), p.y(), ground_.road_height_m(ground_.spot(middle)) + up_m);
    };
    if (!is_clear(item.at + side * wide_m * left, 0.5 * kWalkway_m)) continue;  // another tube crosses
    for (std::size_t k = 1; k < kSection.size(); ++k) {
      const auto &a = kSection[k - 1], &b = kSection[k];
      const double deep_m = has_door && k == 1 ? kDoorDeep_m : 0.0;
      const auto corner = [&](double along_m, const std::array<double, 2>& p) {
        return at(along_m, wide_m * p[0] + deep_m, p[1]);
      };
      add_quad(mesh, {corner(-half_m, a), corner(half_m, a), corner(half_m, b), corner(-half_m, b)},
               deep_m > 0.0 ? metal : concrete);
    }
    if (!has_door) continue;
    for (const double along_m : {-half_m, half_m}) {
      add_quad(mesh,
               {at(along_m, wide_m, -0.3), at(along_m, wide_m + kDoorDeep_m, -0.3),
                at(along_m, wide_m + kDoorDeep_m, 3.6), at(along_m, wide_m, 3.6)},
               concrete);
    }
  }
}

}  // namespace pago::simulator
