// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/ray_caster.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace pago::simulator;
using Eigen::Vector3d;

namespace {

/// Level ground at height i - j, tile by tile, with a wall along the eastern rim.
Mesh steps(const Tile& tile) {
  Mesh mesh;
  mesh.origin << tile.corner(), 0.0;
  const double x = tile.corner().x(), y = tile.corner().y(), z = 0.01 * (tile.i - tile.j);
  add_quad(mesh, {Vector3d(x, y, z), {x + kTile_m, y, z}, {x + kTile_m, y + kTile_m, z}, {x, y + kTile_m, z}},
           {Material::kAsphalt, 100, Label::kRoad});
  add_quad(
      mesh,
      {Vector3d(x + 60, y, z), {x + 60, y + kTile_m, z}, {x + 60, y + kTile_m, z + 3}, {x + 60, y, z + 3}},
      {Material::kBrick, 100, Label::kBuilding});
  return mesh;
}

Hit cast_one(const RayCaster& caster, const Vector3d& from, const Vector3d& way) {
  RayPacket rays;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    rays.set_foot(i, (from - caster.origin()).cast<float>());
    rays.set_way(i, way.normalized().cast<float>());
  }
  std::array<Hit, RayPacket::kSize> hits;
  caster.cast(rays, hits);
  for (const Hit& hit : hits) REQUIRE(hit.range_m == hits[0].range_m);
  return hits[0];
}

}  // namespace

TEST_CASE("a ray meets the first surface, with its meaning and normal", "[simulator][ray_caster]") {
  RayCaster caster(steps);
  caster.move_to({30, 30, 2});
  const Hit down = cast_one(caster, {30, 30, 2}, {0, 0, -1});
  CHECK(down.range_m == Approx(2.0).epsilon(1e-6));
  CHECK(down.surface.label == Label::kRoad);
  CHECK(std::abs(down.normal.normalized().z()) == Approx(1.0));
  const Hit ahead = cast_one(caster, {30, 30, 2}, {1, 0, 0});
  CHECK(ahead.range_m == Approx(30.0).epsilon(1e-6));
  CHECK(ahead.surface.label == Label::kBuilding);
  CHECK_FALSE(cast_one(caster, {30, 30, 2}, {0, 0, 1}).is_there());
}

TEST_CASE("what lies behind something can be asked for", "[simulator][ray_caster]") {
  RayCaster caster(steps);
  caster.move_to({30, 30, 2});
  RayPacket rays;
  rays.set_foot(3, (Vector3d(30, 30, 2) - caster.origin()).cast<float>());
  rays.set_way(3, {1, 0, 0});
  CHECK(caster.cast_on(rays, 3, 0.3F).range_m == Approx(30.0).epsilon(1e-5));
  CHECK(caster.cast_on(rays, 3, 30.5F).range_m == Approx(94.0).epsilon(1e-5));
}

TEST_CASE("kilometres away the ground is as exact, and memory does not grow", "[simulator][ray_caster]") {
  RayCaster caster(steps);
  caster.move_to({30, 30, 2});
  const float before = cast_one(caster, {30, 30, 2}, {3, 1, -0.2}).range_m;
  const std::size_t tiles = caster.num_tiles();
  std::size_t most = 0;
  for (double x = 30.0; x < 5000.0; x += 7.0) {
    caster.move_to({x, 30, 2});
    most = std::max(most, caster.num_tiles());
  }
  CHECK(most < 2 * tiles);
  const double x = 30.0 + 78 * 64;
  caster.move_to({x, 30, 2});
  // 78 tiles on the ground is 0.78 m higher.
  CHECK(std::abs(cast_one(caster, {x, 30, 2.78}, {3, 1, -0.2}).range_m - before) < 1e-4F);
  caster.move_to({30, 30, 2});
  CHECK(std::abs(cast_one(caster, {30, 30, 2}, {3, 1, -0.2}).range_m - before) < 1e-4F);
}
