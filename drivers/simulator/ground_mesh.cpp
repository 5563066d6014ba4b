// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "ground.hpp"

namespace pago::simulator {
namespace {

/// A lattice point, with the vertex that it has on either side of a kerb.
struct Corner {
  Ground::Spot spot;
  std::uint32_t road = 0, land = 0;

  bool is_road() const { return spot.is_on_road(); }
};

/// Where a carriageway's edge crosses a side of a triangle: foot and top of the kerb.
struct Crossing {
  std::uint32_t road = 0, land = 0;
};

class GroundMesher {
 public:
  GroundMesher(Mesh& mesh, const Ground& ground, const Eigen::Vector2d& corner, int cells)
      : mesh_(mesh), ground_(ground), cells_(cells) {
    corners_.reserve(static_cast<std::size_t>((cells + 1) * (cells + 1)));
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i) corners_.push_back(make_corner(corner + Eigen::Vector2d(i, j)));
  }

  void add() {
    for (int j = 0; j < cells_; ++j) {
      for (int i = 0; i < cells_; ++i) {
        add_half(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        add_half(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }

 private:
  const Corner& at(int i, int j) const { return corners_[static_cast<std::size_t>(j * (cells_ + 1) + i)]; }

  std::uint32_t vertex(const Eigen::Vector2d& at, double z_m) {
    return mesh_.add_vertex({at.x(), at.y(), z_m});
  }

  Corner make_corner(const Eigen::Vector2d& at) {
    Corner corner{ground_.spot(at)};
    if (corner.is_road())
      corner.road = vertex(at, ground_.road_height_m(corner.spot));
    else
      corner.land = vertex(at, ground_.land_height_m(corner.spot));
    return corner;
  }

  void add_half(const Corner& a, const Corner& b, const Corner& c) {
    if (a.is_road() == b.is_road() && b.is_road() == c.is_road()) return add_uncut(a, b, c);
    // Turned so that the corner that is alone on its side of the edge comes first.
    if (b.is_road() == c.is_road()) return add_cut(a, b, c);
    if (a.is_road() == c.is_road()) return add_cut(b, c, a);
    add_cut(c, a, b);
  }

  Surface surface_between(const Corner& a, const Corner& b, const Corner& c) const {
    Ground::Spot middle = a.spot;
    middle.at = (a.spot.at + b.spot.at + c.spot.at) / 3.0;
    middle.street.edge_m = (a.spot.street.edge_m + b.spot.street.edge_m + c.spot.street.edge_m) / 3.0;
    return ground_.surface(middle);
  }

  void add_uncut(const Corner& a, const Corner& b, const Corner& c) {
    const Surface surface = surface_between(a, b, c);
    if (a.is_road())
      mesh_.add_triangle(a.road, b.road, c.road, surface);
    else
      mesh_.add_triangle(a.land, b.land, c.land, surface);
  }

  Crossing cross(const Corner& a, const Corner& b) {
    const double share = a.spot.street.edge_m / (a.spot.street.edge_m - b.spot.street.edge_m);
    Ground::Spot spot = a.spot;
    spot.at += share * (b.spot.at - a.spot.at);
    spot.base_m += share * (b.spot.base_m - a.spot.base_m);
    spot.street.edge_m = 0.0;
    return {vertex(spot.at, ground_.road_height_m(spot)), vertex(spot.at, ground_.land_height_m(spot))};
  }

  void add_cut(const Corner& alone, const Corner& b, const Corner& c) {
    const Crossing p = cross(alone, b), q = cross(alone, c);
    Ground::Spot on_road = alone.spot, on_land = alone.spot;
    on_road.street.edge_m = -0.1;
    on_land.street.edge_m = 0.1;
    const Surface road = ground_.surface(on_road), land = ground_.surface(on_land);
    if (alone.is_road()) {
      mesh_.add_triangle(alone.road, p.road, q.road, road);
      mesh_.add_triangle(p.land, b.land, c.land, land);
      mesh_.add_triangle(p.land, c.land, q.land, land);
    } else {
      mesh_.add_triangle(alone.land, p.land, q.land, land);
      mesh_.add_triangle(p.road, b.road, c.road, road);
      mesh_.add_triangle(p.road, c.road, q.road, road);
    }
    mesh_.add_triangle(p.road, q.road, q.land, land);
    mesh_.add_triangle(p.road, q.land, p.land, land);
  }

  Mesh& mesh_;
  const Ground& ground_;
  int cells_;
  std::vector<Corner> corners_;
};

}  // namespace

void add_ground(Mesh& mesh, const Ground& ground, const Eigen::Vector2d& corner, int cells) {
  GroundMesher(mesh, ground, corner, cells).add();
}

}  // namespace pago::simulator
