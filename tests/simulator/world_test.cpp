// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/world.hpp"

#include <array>
#include <map>

#include "drivers/simulator/surroundings.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::simulator;

namespace {

bool are_equal(const Mesh& a, const Mesh& b) {
  return a.origin == b.origin && a.vertices == b.vertices && a.triangles == b.triangles;
}

constexpr std::array kWorlds{SimulatedWorld::kUrban, SimulatedWorld::kRural, SimulatedWorld::kHighway,
                             SimulatedWorld::kTunnel, SimulatedWorld::kField};

SimulatorConfig city(int seed) {
  SimulatorConfig config;
  config.seed = seed;
  config.seconds = 15.0;
  return config;
}

}  // namespace

TEST_CASE("a tile is the same whenever it is built", "[simulator][world]") {
  const Surroundings first = lay_out(city(4)), second = lay_out(city(4)), other = lay_out(city(5));
  const Mesh there = first.world->tile({1, 0});
  for (const Tile& tile : {Tile{-1, 0}, {0, 1}, {2, -1}}) first.world->tile(tile);
  CHECK(are_equal(there, first.world->tile({1, 0})));
  CHECK(are_equal(there, second.world->tile({1, 0})));
  CHECK_FALSE(are_equal(there, other.world->tile({1, 0})));
}

TEST_CASE("a street has what makes a city", "[simulator][world]") {
  const Surroundings surroundings = lay_out(city(1));
  std::map<Label, std::size_t> triangles;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (const Surface& surface : surroundings.world->tile({i, j}).surfaces) ++triangles[surface.label];
  for (const Label label : {Label::kRoad, Label::kSidewalk, Label::kTerrain, Label::kBuilding, Label::kFence,
                            Label::kVegetation, Label::kTrunk, Label::kPole, Label::kTrafficSign, Label::kCar,
                            Label::kLaneMarking, Label::kOtherObject}) {
    INFO("label " << static_cast<int>(label));
    CHECK(triangles[label] > 20);
  }
}

TEST_CASE("every world has what makes it, and each tile once and for all", "[simulator][world]") {
  const auto expect = [](SimulatedWorld which, std::initializer_list<Label> wanted, Label absent) {
    SimulatorConfig config = city(3);
    config.world = which;
    config.seconds = 6.0;
    const Surroundings surroundings = lay_out(config), again = lay_out(config);
    CHECK(are_equal(surroundings.world->tile({1, 0}), again.world->tile({1, 0})));
    std::map<Label, std::size_t> triangles;
    const Tile here = Tile::of(surroundings.T_world_base->pose(3.0).translation().head<2>());
    for (int i = here.i - 2; i <= here.i + 2; ++i)
      for (int j = here.j - 2; j <= here.j + 2; ++j)
        for (const Surface& surface : surroundings.world->tile({i, j}).surfaces) ++triangles[surface.label];
    for (const Label label : wanted) {
      INFO("world " << static_cast<int>(which) << ", label " << static_cast<int>(label));
      CHECK(triangles[label] > 20);
    }
    CHECK(triangles[absent] == 0);
  };
  expect(SimulatedWorld::kRural,
         {Label::kRoad, Label::kTerrain, Label::kVegetation, Label::kTrunk, Label::kPole}, Label::kSidewalk);
  expect(SimulatedWorld::kHighway, {Label::kRoad, Label::kTerrain, Label::kFence, Label::kPole},
         Label::kBuilding);
  expect(SimulatedWorld::kTunnel, {Label::kRoad, Label::kOtherStructure}, Label::kBuilding);
  expect(SimulatedWorld::kField, {Label::kTerrain, Label::kOtherGround}, Label::kRoad);
}

TEST_CASE("nothing stands in the vehicle's way", "[simulator][world]") {
  SimulatorConfig config = city(2);
  config.world = GENERATE(from_range(kWorlds));
  INFO("world " << static_cast<int>(config.world));
  if (config.world != SimulatedWorld::kUrban) config.seconds = 8.0;
  const Surroundings surroundings = lay_out(config);
  RayCaster caster([&](const Tile& tile) { return surroundings.world->tile(tile); });
  const Trajectory& drive = *surroundings.T_world_base;
  for (double t = 0.0; t < drive.duration_s(); t += 0.4) {
    const Eigen::Isometry3d T = drive.pose(t);
    caster.move_to(T.translation());
    RayPacket rays;
    // Around the vehicle at bumper height: free for as far as it is wide.
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
      const double turn = 0.785 * static_cast<double>(i);
      rays.set_foot(i, (T * Eigen::Vector3d(0, 0, 0.5) - caster.origin()).cast<float>());
      rays.set_way(i, (T.linear() * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0)).cast<float>());
    }
    std::array<Hit, RayPacket::kSize> hits;
    caster.cast(rays, hits);
    for (const Hit& hit : hits) REQUIRE(hit.range_m > 1.0F);
  }
}
