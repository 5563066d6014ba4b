// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pago::simulator {

/// SemanticKITTI's classes (Behley et al. 2019), as many as the worlds have.
enum class Label : std::uint16_t {
  kUnlabelled = 0,
  kOutlier = 1,
  kCar = 10,
  kTruck = 18,
  kPerson = 30,
  kRoad = 40,
  kParking = 44,
  kSidewalk = 48,
  kOtherGround = 49,
  kBuilding = 50,
  kFence = 51,
  kOtherStructure = 52,
  kLaneMarking = 60,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
  kTrafficSign = 81,
  kOtherObject = 99,
  kMovingCar = 252,
  kMovingPerson = 254,
  kMovingTruck = 258
};

enum class Material : std::uint8_t {
  kAsphalt,
  kPaint,  ///< lane markings
  kPaving,
  kPlaster,
  kBrick,
  kConcrete,
  kGlass,
  kCarPaint,
  kRubber,
  kMetal,
  kWood,
  kLeaf,
  kBark,
  kGrass,
  kSoil,
  kSign,  ///< retro-reflective
  kCloth,
  kWire,    ///< a fence whose meshes are finer than the mesh of triangles: most of a beam goes through
  kMeadow,  ///< grass as it grows when nobody mows it: beams end anywhere in it
  kCount
};

/// What a triangle is made of and means.
struct Surface {
  Material material = Material::kAsphalt;
  std::uint8_t shade = 128;  ///< of this object among its kind: 0 dark, 255 bright
  Label label = Label::kUnlabelled;
};

}  // namespace pago::simulator
