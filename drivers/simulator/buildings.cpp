// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "buildings.hpp"

#include <algorithm>
#include <cmath>

namespace pago::simulator {
namespace {

constexpr double kFoot_m = 0.6;  // how deep walls reach below the lowest ground

/// An upright rectangle of a plot, parallel to its front.
void add_panel(
    Mesh& mesh, const Plot& plot, Eigen::Array2d right_m, double in_m, Eigen::Array2d z_m, Surface surface) {
  if (right_m[1] - right_m[0] < 0.01 || z_m[1] - z_m[0] < 0.01) return;
  add_quad(mesh,
           {plot.at(right_m[0], in_m, z_m[0]), plot.at(right_m[1], in_m, z_m[0]),
            plot.at(right_m[1], in_m, z_m[1]), plot.at(right_m[0], in_m, z_m[1])},
           surface);
}

/// A hole in the front, `deep_m` deep, with its four reveals and what closes it.
void add_niche(Mesh& mesh,
               const Plot& plot,
               Eigen::Array2d right_m,
               Eigen::Array2d z_m,
               double deep_m,
               Surface wall,
               Surface back) {
  for (const double right : {right_m[0], right_m[1]}) {
    add_quad(mesh,
             {plot.at(right, 0.0, z_m[0]), plot.at(right, deep_m, z_m[0]), plot.at(right, deep_m, z_m[1]),
              plot.at(right, 0.0, z_m[1])},
             wall);
  }
  for (const double z : {z_m[0], z_m[1]}) {
    add_quad(mesh,
             {plot.at(right_m[0], 0.0, z), plot.at(right_m[1], 0.0, z), plot.at(right_m[1], deep_m, z),
              plot.at(right_m[0], deep_m, z)},
             wall);
  }
  add_panel(mesh, plot, right_m, deep_m, z_m, back);
}

struct Storey {
  double floor_m, height_m, window_low_m, window_high_m;
  int door = -1;  ///< the bay that has the door
};

void add_storey(Mesh& mesh, const Plot& plot, const Storey& storey, int bays, Surface wall, Random& random) {
  const Surface glass{Material::kGlass, 128, wall.label}, wood{Material::kWood, 100, wall.label};
  const double bay_m = plot.width_m / bays, low = storey.floor_m + storey.window_low_m;
  const double high = storey.floor_m + storey.window_high_m, top = storey.floor_m + storey.height_m;
  const double half_window_m = std::min(0.65, 0.3 * bay_m), deep_m = random.between(0.12, 0.3);
  add_panel(mesh, plot, {0.0, plot.width_m}, 0.0, {high, top}, wall);
  double wall_from = 0.0, foot_from = 0.0;
  for (int bay = 0; bay < bays; ++bay) {
    const double middle = bay_m * (bay + 0.5);
    const Eigen::Array2d hole(middle - half_window_m, middle + half_window_m);
    add_panel(mesh, plot, {wall_from, hole[0]}, 0.0, {low, high}, wall);
    wall_from = hole[1];
    if (bay == storey.door) {
      add_panel(mesh, plot, {foot_from, hole[0]}, 0.0, {storey.floor_m - kFoot_m, low}, wall);
      add_niche(mesh, plot, hole, {storey.floor_m - kFoot_m, high}, 3.0 * deep_m, wall, wood);
      foot_from = hole[1];
    } else {
      // Some have their blinds down: those are no glass.
      const bool is_shut = random.chance(0.35);
      add_niche(mesh, plot, hole, {low, high}, deep_m, wall, is_shut ? wood : glass);
    }
  }
  add_panel(mesh, plot, {wall_from, plot.width_m}, 0.0, {low, high}, wall);
  add_panel(mesh, plot, {foot_from, plot.width_m}, 0.0,
            {storey.floor_m - (storey.door >= 0 ? kFoot_m : 0.0), low}, wall);
}

void add_shell(Mesh& mesh, const Plot& plot, double eaves_m, Surface wall) {
  const double low = plot.low_m - kFoot_m, w = plot.width_m, d = plot.depth_m, ridge_m = eaves_m + 0.35 * d;
  for (const double right : {0.0, w}) {
    add_quad(mesh,
             {plot.at(right, 0.0, low), plot.at(right, d, low), plot.at(right, d, eaves_m),
              plot.at(right, 0.0, eaves_m)},
             wall);
    add_triangle(mesh, plot.at(right, 0.0, eaves_m), plot.at(right, d, eaves_m),
                 plot.at(right, 0.5 * d, ridge_m), wall);
  }
  add_panel(mesh, plot, {0.0, w}, d, {low, eaves_m}, wall);
  const Surface tiles{Material::kBrick, 90, wall.label};
  for (const double in : {0.0, d}) {
    const double over = in > 0.0 ? d + 0.4 : -0.4;
    add_quad(mesh,
             {plot.at(-0.2, over, eaves_m - 0.25), plot.at(w + 0.2, over, eaves_m - 0.25),
              plot.at(w + 0.2, 0.5 * d, ridge_m), plot.at(-0.2, 0.5 * d, ridge_m)},
             tiles);
  }
}

}  // namespace

void add_house(Mesh& mesh, const Plot& plot, int storeys, Random& random) {
  const auto shade = static_cast<std::uint8_t>(60 + random.below(190));
  const Surface wall{random.chance(0.3) ? Material::kBrick : Material::kPlaster, shade, Label::kBuilding};
  const int bays = std::max(1, static_cast<int>(plot.width_m / random.between(2.6, 3.6)));
  const double storey_m = random.between(2.8, 3.3);
  double floor_m = plot.low_m;
  for (int i = 0; i < storeys; ++i) {
    const Storey storey{floor_m, i == 0 ? storey_m + 0.4 : storey_m, i == 0 ? 1.2 : 0.9, i == 0 ? 2.7 : 2.4,
                        i == 0 ? random.below(bays) : -1};
    add_storey(mesh, plot, storey, bays, wall, random);
    floor_m += storey.height_m;
  }
  add_shell(mesh, plot, floor_m, wall);
}

void add_wall(Mesh& mesh, const Plot& plot, double height_m, Random& random) {
  const Surface wall{random.chance(0.5) ? Material::kBrick : Material::kConcrete,
                     static_cast<std::uint8_t>(80 + random.below(120)), Label::kFence};
  const double thick_m = 0.25, top = plot.low_m + height_m;
  // Pillars at the front, the wall between them set back.
  const int parts = std::max(1, static_cast<int>(plot.width_m / 3.5));
  for (int i = 0; i <= parts; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear().col(0) << plot.along, 0.0;
    T.linear().col(1) << plot.inward, 0.0;
    T.linear().col(2) = T.linear().col(0).cross(T.linear().col(1));
    T.translation() =
        plot.at(plot.width_m * i / parts, 0.5 * thick_m, 0.5 * (top + 0.15 + plot.low_m - kFoot_m));
    add_box(mesh, T, {0.4, 0.4, top + 0.15 - plot.low_m + kFoot_m}, wall);
  }
  for (const double in : {0.05, thick_m - 0.05})
    add_panel(mesh, plot, {0.0, plot.width_m}, in, {plot.low_m - kFoot_m, top}, wall);
}

void add_picket_fence(Mesh& mesh, const Plot& plot, double height_m) {
  const Surface wood{Material::kWood, 150, Label::kFence};
  constexpr double kPitch_m = 0.16, kPicket_m = 0.09;
  for (double right = 0.0; right + kPicket_m < plot.width_m; right += kPitch_m) {
    add_panel(mesh, plot, {right, right + kPicket_m}, 0.0, {plot.low_m - kFoot_m, plot.low_m + height_m},
              wood);
  }
  for (const double z : {0.25, height_m - 0.2})
    add_panel(mesh, plot, {0.0, plot.width_m}, 0.04, {plot.low_m + z, plot.low_m + z + 0.07}, wood);
}

void add_wire_fence(Mesh& mesh, const Plot& plot, double height_m) {
  const double low = plot.low_m - kFoot_m, top = plot.low_m + height_m;
  add_panel(mesh, plot, {0.0, plot.width_m}, 0.0, {low, top}, {Material::kWire, 128, Label::kFence});
  for (double right = 0.0; right <= plot.width_m; right += 2.5)
    add_bar(mesh, plot.at(right, 0.05, low), plot.at(right, 0.05, top), 0.03, 0.03, 6,
            {Material::kMetal, 128, Label::kFence});
}

void add_hedge(Mesh& mesh, const Plot& plot, double height_m, Random& random) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().col(0) << plot.along, 0.0;
  T.linear().col(1) << plot.inward, 0.0;
  T.linear().col(2) = T.linear().col(0).cross(T.linear().col(1));
  const double thick_m = random.between(0.6, 1.0);
  T.translation() = plot.at(0.5 * plot.width_m, 0.5 * thick_m, plot.low_m - 0.1 + 0.5 * height_m);
  const Foliage leaves{.half_m = Eigen::Vector3d(plot.width_m, thick_m, height_m + 0.2) * 0.5,
                       .is_box = true,
                       .count = static_cast<int>(110.0 * plot.width_m * thick_m * height_m),
                       .leaf_m = 0.14};
  add_foliage(mesh, T, leaves, random, {Material::kLeaf, 128, Label::kVegetation});
}

}  // namespace pago::simulator
