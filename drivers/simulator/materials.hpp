// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.hpp"

namespace pago::simulator {

/// What a material does to a beam of 905 nm.
struct Optics {
  double reflectivity;  ///< of a diffuse target of middle shade; 1 returns all, retro-reflectors more
  double shine;         ///< part of the light that is mirrored away unless the beam comes square on
  double transmission;  ///< chance that the beam goes through
  double pile_m;        ///< depth of blades and twigs that it may be stopped in before it reaches the surface
  bool is_uneven;       ///< has hollows and rises too small for the mesh of triangles
};
const Optics& optics(Material material) noexcept;

/// How high a surface stands out of its triangles at this place of the world. Places next to each other are
/// about as high; a place is as high whenever it is seen.
double relief_m(Material material, double x_m, double y_m) noexcept;

/// 0.4 to 1.6 of the material's own, by shade.
inline double reflectivity(const Surface& surface) noexcept {
  return optics(surface.material).reflectivity * (0.4 + 1.2 * surface.shade / 255.0);
}

}  // namespace pago::simulator
