// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh.hpp"

#include <cmath>
#include <numbers>

namespace pago::simulator {

void add_triangle(Mesh& mesh,
                  const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c,
                  Surface surface) {
  const std::uint32_t first = mesh.add_vertex(a);
  mesh.add_vertex(b);
  mesh.add_vertex(c);
  mesh.add_triangle(first, first + 1, first + 2, surface);
}

void add_quad(Mesh& mesh, const std::array<Eigen::Vector3d, 4>& corners, Surface surface) {
  const std::uint32_t first = mesh.add_vertex(corners[0]);
  for (std::size_t i = 1; i < 4; ++i) mesh.add_vertex(corners[i]);
  mesh.add_triangle(first, first + 1, first + 2, surface);
  mesh.add_triangle(first, first + 2, first + 3, surface);
}

void add_box(Mesh& mesh, const Eigen::Isometry3d& T, const Eigen::Vector3d& size, Surface surface) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                               (corner & 4) != 0 ? 0.5 : -0.5);
    mesh.add_vertex(T * sign.cwiseProduct(size));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& face : kFaces) {
    mesh.add_triangle(first + face[0], first + face[1], first + face[2], surface);
    mesh.add_triangle(first + face[0], first + face[2], first + face[3], surface);
  }
}

void add_bar(Mesh& mesh,
             const Eigen::Vector3d& from,
             const Eigen::Vector3d& to,
             double from_radius_m,
             double to_radius_m,
             int sides,
             Surface surface) {
  const Eigen::Vector3d axis = (to - from).normalized();
  const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Eigen::Vector3d out = std::cos(angle) * u + std::sin(angle) * v;
    mesh.add_vertex(from + from_radius_m * out);
    mesh.add_vertex(to + to_radius_m * out);
  }
  const auto n = static_cast<std::uint32_t>(2 * sides);
  for (std::uint32_t i = 0; i < n; i += 2) {
    const std::uint32_t a = first + i, b = first + (i + 2) % n;
    mesh.add_triangle(a, b, b + 1, surface);
    mesh.add_triangle(a, b + 1, a + 1, surface);
  }
}

void add_foliage(
    Mesh& mesh, const Eigen::Isometry3d& T, const Foliage& foliage, Random& random, Surface surface) {
  const auto inside = [&] {
    for (;;) {
      const Eigen::Vector3d p(random.between(-1.0, 1.0), random.between(-1.0, 1.0),
                              random.between(-1.0, 1.0));
      if (foliage.is_box || p.squaredNorm() <= 1.0) return p;
    }
  };
  for (int i = 0; i < foliage.count; ++i) {
    const Eigen::Vector3d centre = inside().cwiseProduct(foliage.half_m);
    const double size_m = foliage.leaf_m * random.between(0.6, 1.4);
    const Eigen::Vector3d u = size_m * inside(), v = size_m * inside();
    add_triangle(mesh, T * centre, T * (centre + u), T * (centre + v), surface);
  }
}

void add_mesh(Mesh& mesh, const Mesh& part, const Eigen::Isometry3d& T, double scale) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : part.vertices)
    mesh.add_vertex(T * (scale * (vertex.cast<double>() + part.origin)));
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  mesh.surfaces.insert(mesh.surfaces.end(), part.surfaces.begin(), part.surfaces.end());
}

}  // namespace pago::simulator
