// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "materials.hpp"

#include <array>

#include "random.hpp"

namespace pago::simulator {
namespace {

/// On KITTI's streets returns of one ring within 2 m of each other, 5 to 10 m away, lie 6 to 7 mm (rms) off
/// their plane, and their noise makes 3 mm of that.
constexpr double kRelief_m = 0.02, kReliefSize_m = 1.0;

}  // namespace

// Reflectivities as tables of lidar makers give them for 905 nm, rounded. Depths of pile: on SemanticKITTI's
// terrain neighbouring returns of a ring differ by 4 mm of height from 5 m to 45 m (docs/simulator.md); a
// meadow has three times as much.
const Optics& optics(Material material) noexcept {
  static constexpr std::array<Optics, static_cast<std::size_t>(Material::kCount)> kOptics{{
      {0.17, 0.1, 0.0, 0.0, true},    // asphalt
      {0.50, 0.1, 0.0, 0.0, true},    // paint
      {0.30, 0.0, 0.0, 0.0, true},    // paving
      {0.50, 0.0, 0.0, 0.0, false},   // plaster
      {0.40, 0.0, 0.0, 0.0, false},   // brick
      {0.40, 0.0, 0.0, 0.0, false},   // concrete
      {0.10, 0.8, 0.55, 0.0, false},  // glass
      {0.30, 0.5, 0.0, 0.0, false},   // car paint
      {0.07, 0.0, 0.0, 0.0, false},   // rubber
      {0.40, 0.3, 0.0, 0.0, false},   // metal
      {0.40, 0.0, 0.0, 0.0, false},   // wood
      {0.50, 0.0, 0.0, 0.0, false},   // leaf
      {0.30, 0.0, 0.0, 0.0, false},   // bark
      {0.45, 0.0, 0.0, 0.004, true},  // grass
      {0.25, 0.0, 0.0, 0.003, true},  // soil
      {6.00, 0.0, 0.0, 0.0, false},   // sign
      {0.35, 0.0, 0.0, 0.0, false},   // cloth
      {0.30, 0.0, 0.75, 0.0, false},  // wire
      {0.45, 0.0, 0.0, 0.012, true},  // meadow
  }};
  return kOptics[static_cast<std::size_t>(material)];
}

double relief_m(Material material, double x_m, double y_m) noexcept {
  constexpr std::uint64_t kSeed = 0x5E11EF;
  return optics(material).is_uneven ? kRelief_m * noise(kSeed, x_m, y_m, kReliefSize_m) : 0.0;
}

}  // namespace pago::simulator
