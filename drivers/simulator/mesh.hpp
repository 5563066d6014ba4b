// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "random.hpp"
#include "surface.hpp"

namespace pago::simulator {

/// Triangles, each with its surface. Vertices in metres about the mesh's own origin, so that single precision
/// keeps a tenth of a millimetre anywhere in the world.
struct Mesh {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Surface> surfaces;

  std::uint32_t add_vertex(const Eigen::Vector3d& p) {
    vertices.emplace_back((p - origin).cast<float>());
    return static_cast<std::uint32_t>(vertices.size() - 1);
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Surface surface) {
    triangles.push_back({a, b, c});
    surfaces.push_back(surface);
  }
};

// Shapes, in the coordinates of Mesh::origin's frame. Beams hit both sides of a triangle, so the order of
// corners does not matter.

void add_triangle(Mesh& mesh,
                  const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c,
                  Surface surface);
/// Corners in order around; need not be flat.
void add_quad(Mesh& mesh, const std::array<Eigen::Vector3d, 4>& corners, Surface surface);
/// A box with its centre at T's origin.
void add_box(Mesh& mesh, const Eigen::Isometry3d& T, const Eigen::Vector3d& size, Surface surface);
/// A round bar, open at both ends, which must not coincide.
void add_bar(Mesh& mesh,
             const Eigen::Vector3d& from,
             const Eigen::Vector3d& to,
             double from_radius_m,
             double to_radius_m,
             int sides,
             Surface surface);
/// `count` leaves of about `leaf_m`, spread evenly through the ellipsoid with these half axes, or through the
/// box with `is_box`, about T's origin.
struct Foliage {
  Eigen::Vector3d half_m = Eigen::Vector3d::Ones();
  bool is_box = false;
  int count = 0;
  double leaf_m = 0.2;
};
void add_foliage(
    Mesh& mesh, const Eigen::Isometry3d& T, const Foliage& foliage, Random& random, Surface surface);

/// A copy of another mesh, moved and scaled.
void add_mesh(Mesh& mesh, const Mesh& part, const Eigen::Isometry3d& T, double scale = 1.0);

}  // namespace pago::simulator
