// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "presets.hpp"

namespace pago::simulator {
namespace {

const Surface kVerge{Material::kGrass, 128, Label::kTerrain};

Town no_town() {
  return {.plots = 0.0, .has_furniture = false, .parked = 0.0};
}

Preset urban() {
  Preset preset;
  preset.ground.road_roughness_m = 0.007;
  preset.ground.speed_bumps = 0.15;
  preset.has_uneven_streets = true;
  preset.road.half_width_m = 5.5;
  return preset;
}

Preset rural() {
  Preset preset;
  GroundStyle& ground = preset.ground;
  preset.has_uneven_streets = true;
  ground.kerb_low_m = -0.05;
  ground.kerb_high_m = 0.01;
  ground.sidewalk_m = 1.2;
  ground.side = kVerge;
  ground.road_roughness_m = 0.008;
  ground.yard_bump_m = 0.06;
  ground.relief_m = 4.0;
  ground.ditch_m = 0.6;
  ground.bank_m = 2.2;
  ground.yard = {Material::kMeadow, 128, Label::kTerrain};
  preset.scenery.town = {.plots = 0.05,
                         .house = 0.8,
                         .gap = 1.0,
                         .set_back = 1.0,
                         .low_storeys = 1,
                         .high_storeys = 2,
                         .has_furniture = false,
                         .parked = 0.0};
  preset.scenery.roadside = {.hedge = 0.22,
                             .wire_fence = 0.15,
                             .tree_row = 0.15,
                             .poles = 0.1,
                             .guard_rail = 0.08,
                             .post_every_m = 50.0,
                             .tall_grass = 0.35};
  preset.scenery.land = {.tree = 0.03, .wood = 0.3};
  preset.traffic = {.oncoming_per_s = 0.06,
                    .oncoming_left_m = 3.0,
                    .oncoming_slow_m_s = 13.0,
                    .oncoming_fast_m_s = 22.0,
                    .leading = 0.3,
                    .following = 0.3,
                    .pedestrians_per_m = 0.002,
                    .sidewalk_right_m = 2.2,
                    .sidewalk_left_m = 5.0};
  preset.pace = {.cruise_m_s = 16.0, .lateral_m_s2 = 2.6};
  preset.road.stops_per_km = 0.4;
  return preset;
}

Preset highway() {
  Preset preset;
  GroundStyle& ground = preset.ground;
  ground.kerb_low_m = -0.03;
  ground.kerb_high_m = 0.0;
  ground.sidewalk_m = 1.5;
  ground.side = kVerge;
  ground.road_roughness_m = 0.003;
  ground.bank_m = 3.0;
  ground.relief_m = 2.0;
  preset.scenery.town = no_town();
  preset.scenery.roadside = {.hedge = 0.05,
                             .wire_fence = 0.3,
                             .tree_row = 0.05,
                             .noise_wall = 0.06,
                             .near_m = 7.0,
                             .far_m = 14.0,
                             .guard_rail = 0.5,
                             .post_every_m = 50.0,
                             .bridge_every_m = 700.0};
  preset.scenery.land = {.tree = 0.008};
  preset.scenery.marking_left_m = 1.0;
  preset.traffic = {.oncoming_per_s = 0.3,
                    .oncoming_left_m = 16.8,
                    .oncoming_slow_m_s = 23.0,
                    .oncoming_fast_m_s = 34.0,
                    .leading = 0.7,
                    .following = 0.6,
                    .passing_per_s = 0.12,
                    .pedestrians_per_m = 0.0};
  preset.pace = {.cruise_m_s = 27.0, .start_m_s = 25.0};
  preset.road = {.half_width_m = 5.5,
                 .lane_m = 0.9,
                 .median_m = 4.0,
                 .sweep = {0.3, 800.0},
                 .bend = {0.05, 250.0},
                 .hills = {8.0, 700.0},
                 .ripples = {0.5, 200.0},
                 .least_loop_m = 3000.0};
  return preset;
}

Preset tunnel() {
  Preset preset;
  preset.ground.road_roughness_m = 0.003;
  preset.ground.sidewalk_m = 2.5;
  preset.ground.relief_m = 0.0;
  preset.scenery.town = no_town();
  preset.scenery.roadside = {.is_tunnel = true};
  preset.scenery.land = {.tree = 0.0};
  preset.traffic = {.oncoming_per_s = 0.15,
                    .oncoming_left_m = 3.6,
                    .oncoming_slow_m_s = 14.0,
                    .oncoming_fast_m_s = 20.0,
                    .pedestrians_per_m = 0.0};
  preset.pace = {.cruise_m_s = 16.0, .start_m_s = 14.0};
  preset.road = {.half_width_m = 4.2,
                 .lane_m = 1.8,
                 .sweep = {0.25, 500.0},
                 .bend = {0.0, 100.0},
                 .hills = {4.0, 600.0},
                 .ripples = {0.0, 100.0},
                 .least_loop_m = 2000.0};
  return preset;
}

Preset field() {
  Preset preset;
  GroundStyle& ground = preset.ground;
  ground.kerb_low_m = -0.01;
  ground.kerb_high_m = 0.01;
  ground.sidewalk_m = 0.5;
  ground.road = {Material::kSoil, 128, Label::kOtherGround};
  ground.side = kVerge;
  ground.road_roughness_m = 0.012;
  ground.yard_bump_m = 0.02;
  ground.relief_m = 0.3;
  preset.scenery.town = no_town();
  preset.scenery.land = {.tree = 0.002};
  preset.scenery.is_marked = false;
  preset.traffic = {.oncoming_per_s = 0.0, .leading = 0.0, .following = 0.0, .pedestrians_per_m = 0.001};
  preset.pace = {.cruise_m_s = 8.0};
  preset.road = {.half_width_m = 1.5,
                 .lane_m = 0.0,
                 .hills = {0.6, 300.0},
                 .ripples = {0.0, 100.0},
                 .stops_per_km = 1.0};
  return preset;
}

}  // namespace

Preset preset_of(SimulatedWorld world) {
  switch (world) {
    case SimulatedWorld::kUrban:
      return urban();
    case SimulatedWorld::kRural:
      return rural();
    case SimulatedWorld::kHighway:
      return highway();
    case SimulatedWorld::kTunnel:
      return tunnel();
    case SimulatedWorld::kField:
      return field();
  }
  return urban();
}

}  // namespace pago::simulator
