// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh.hpp"

namespace pago::simulator {

/// A thing that stands on the ground or moves over it: about its own origin on the ground, x forward.
struct Model {
  Mesh mesh;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();  ///< of its box
};

enum class CarShape : std::uint8_t { kHatchback, kSaloon, kVan, kTruck };

/// 4 to 7 m long, with glass and wheels. `label` is kCar or kMovingCar, say.
Model car_model(CarShape shape, std::uint8_t shade, Label label);
/// Walking, 1.6 to 1.9 m.
Model person_model(Random& random, Label label);
/// Trunk, main branches and a crown of leaves, about `height_m` high.
Model tree_model(Random& random, double height_m, double crown_m);
Model bush_model(Random& random, double height_m);
/// Blades of grass with room for beams between them.
Model tuft_model(Random& random, double height_m);

}  // namespace pago::simulator
