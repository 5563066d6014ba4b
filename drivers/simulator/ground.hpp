// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mesh.hpp"
#include "streets.hpp"

namespace pago::simulator {

/// What the land beside the carriageways looks like. Lengths in metres.
struct GroundStyle {
  double kerb_low_m = 0.10, kerb_high_m = 0.15;
  double sidewalk_m = 2.3;
  double road_roughness_m = 0.005;  ///< amplitude over 1.5 m; longer waves are higher
  double yard_bump_m = 0.03;        ///< amplitude of the bumps beyond the sidewalk, over 2 m
  double relief_m = 1.5;            ///< amplitude of the land's own hills, away from streets, over 60 m
  double speed_bumps = 0.0;         ///< per 80 m of street
  double ditch_m = 0.0;             ///< deepest, 1 to 4 m beside the carriageway
  double bank_m = 0.0;              ///< how far the land beside the road rises or falls at most
  Surface road{Material::kAsphalt, 128, Label::kRoad};
  Surface side{Material::kPaving, 128, Label::kSidewalk};  ///< within sidewalk_m of the carriageway
  Surface yard{Material::kGrass, 128, Label::kTerrain};
};

/// The land: streets keep their heights, and in between it is drawn over them like a cloth. A function of
/// place alone. [set-up] the constructor; [any thread] the rest.
class Ground {
 public:
  Ground(StreetMap streets, const GroundStyle& style, std::uint64_t seed);

  /// What both kinds of height need to know of a place.
  struct Spot {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    StreetPlace street;
    double base_m = 0.0;  ///< height of the carriageways' surface, continued over the land

    bool is_on_road() const noexcept { return street.edge_m < 0.0; }
  };
  Spot spot(const Eigen::Vector2d& at) const noexcept;

  /// Of the carriageway, whether the spot is on it or not: what lies at the foot of a kerb.
  double road_height_m(const Spot& spot) const noexcept;
  /// Of the land beside it: what lies at a kerb's top.
  double land_height_m(const Spot& spot) const noexcept;
  double height_m(const Spot& spot) const noexcept {
    return spot.is_on_road() ? road_height_m(spot) : land_height_m(spot);
  }
  double height_m(const Eigen::Vector2d& at) const noexcept { return height_m(spot(at)); }
  Surface surface(const Spot& spot) const noexcept;

  const StreetMap& streets() const noexcept { return streets_; }
  const GroundStyle& style() const noexcept { return style_; }

 private:
  double far_height_m(const Eigen::Vector2d& at) const noexcept;
  double waves_m(const Eigen::Vector2d& at) const noexcept;
  double verge_m(const Spot& spot) const noexcept;
  double speed_bump_m(const StreetPlace& street) const noexcept;

  StreetMap streets_;
  GroundStyle style_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3d> far_points_;
  std::vector<double> street_length_m_;
};

/// The ground of the square tile with this corner, as a mesh of cells of 1 m that are cut along the
/// carriageways' edges, where kerbs stand upright.
void add_ground(Mesh& mesh, const Ground& ground, const Eigen::Vector2d& corner, int cells);

}  // namespace pago::simulator
