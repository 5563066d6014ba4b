// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh.hpp"

namespace pago::simulator {

/// A stretch of ground seen from the street: `corner` is its front end on the left, `along` leads to the
/// right along the front, `inward` away from the street; unit vectors.
struct Plot {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX(), inward = Eigen::Vector2d::UnitY();
  double width_m = 10.0, depth_m = 9.0;
  double low_m = 0.0;  ///< of the ground below it, its lowest point

  Eigen::Vector3d at(double right_m, double in_m, double z_m) const {
    const Eigen::Vector2d p = corner + right_m * along + in_m * inward;
    return {p.x(), p.y(), z_m};
  }
};

/// A house on a plot: a front with bays of windows and a door, set back into the wall; plain sides and roof.
void add_house(Mesh& mesh, const Plot& plot, int storeys, Random& random);
/// What closes a plot off from the street, along its front.
void add_wall(Mesh& mesh, const Plot& plot, double height_m, Random& random);
void add_picket_fence(Mesh& mesh, const Plot& plot, double height_m);
void add_wire_fence(Mesh& mesh, const Plot& plot, double height_m);
void add_hedge(Mesh& mesh, const Plot& plot, double height_m, Random& random);

}  // namespace pago::simulator
