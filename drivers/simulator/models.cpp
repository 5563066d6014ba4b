// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "models.hpp"

#include <cmath>
#include <numbers>
#include <span>

namespace pago::simulator {
namespace {

using Eigen::Vector3d;

Model finished(Mesh mesh) {
  Model model{std::move(mesh)};
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : model.mesh.vertices) box.extend(vertex.cast<double>());
  model.low = box.min();
  model.high = box.max();
  return model;
}

Eigen::Isometry3d moved(const Vector3d& to) {
  return Eigen::Isometry3d(Eigen::Translation3d(to));
}

/// A car cut across at x: heights of sill, belt line and roof, half widths at belt line and roof.
struct Section {
  double x, sill, belt, roof, half_belt, half_roof;
};

// Sections from bumper to bumper; where belt and roof are equal there is no cabin. Typical European cars.
constexpr std::array kHatchback{
    Section{2.0, 0.35, 0.65, 0.65, 0.75, 0.75},  Section{1.9, 0.22, 0.75, 0.75, 0.86, 0.8},
    Section{0.95, 0.2, 0.95, 0.97, 0.88, 0.7},   Section{0.25, 0.2, 0.95, 1.44, 0.88, 0.6},
    Section{-1.3, 0.2, 0.98, 1.46, 0.88, 0.6},   Section{-1.95, 0.25, 1.0, 1.02, 0.84, 0.7},
    Section{-2.05, 0.35, 0.75, 0.75, 0.78, 0.75}};
constexpr std::array kSaloon{
    Section{2.35, 0.35, 0.6, 0.6, 0.75, 0.75},  Section{2.2, 0.22, 0.7, 0.7, 0.88, 0.8},
    Section{1.0, 0.2, 0.92, 0.94, 0.9, 0.7},    Section{0.2, 0.2, 0.94, 1.42, 0.9, 0.58},
    Section{-1.0, 0.2, 0.96, 1.42, 0.9, 0.58},  Section{-1.7, 0.2, 1.0, 1.02, 0.88, 0.7},
    Section{-2.3, 0.25, 0.95, 0.95, 0.84, 0.8}, Section{-2.4, 0.35, 0.7, 0.7, 0.78, 0.75}};
constexpr std::array kVan{
    Section{2.5, 0.35, 0.8, 0.8, 0.85, 0.85},   Section{2.35, 0.25, 1.05, 1.05, 0.95, 0.9},
    Section{1.6, 0.22, 1.2, 1.3, 0.97, 0.85},   Section{1.0, 0.22, 1.2, 1.95, 0.97, 0.82},
    Section{-2.3, 0.22, 1.25, 2.0, 0.97, 0.85}, Section{-2.5, 0.3, 1.25, 1.9, 0.95, 0.83}};
constexpr std::array kTruck{
    Section{3.6, 0.45, 1.0, 1.1, 1.1, 1.1},  Section{3.5, 0.4, 1.3, 2.7, 1.15, 1.1},
    Section{2.0, 0.4, 1.3, 2.8, 1.15, 1.1},  Section{1.95, 0.7, 1.5, 3.3, 1.22, 1.2},
    Section{-3.5, 0.7, 1.5, 3.3, 1.22, 1.2}, Section{-3.55, 0.8, 1.5, 3.3, 1.2, 1.18}};

std::span<const Section> sections_of(CarShape shape) {
  switch (shape) {
    case CarShape::kHatchback:
      return kHatchback;
    case CarShape::kSaloon:
      return kSaloon;
    case CarShape::kVan:
      return kVan;
    case CarShape::kTruck:
      return kTruck;
  }
  return kSaloon;
}

void add_hull(Mesh& mesh, const Section& a, const Section& b, const Surface& paint, const Surface& pane) {
  for (const double side : {1.0, -1.0}) {
    const auto sill = [&](const Section& s) { return Vector3d(s.x, side * 0.96 * s.half_belt, s.sill); };
    const auto belt = [&](const Section& s) { return Vector3d(s.x, side * s.half_belt, s.belt); };
    const auto roof = [&](const Section& s) { return Vector3d(s.x, side * s.half_roof, s.roof); };
    add_quad(mesh, {sill(a), sill(b), belt(b), belt(a)}, paint);
    add_quad(mesh, {belt(a), belt(b), roof(b), roof(a)}, pane);
  }
  // Bonnet and boot, screens, roof: whatever spans the car's width on top.
  const bool is_screen = std::abs(a.roof - b.roof) > 0.3;
  add_quad(mesh,
           {Vector3d(a.x, a.half_roof, a.roof), Vector3d(a.x, -a.half_roof, a.roof),
            Vector3d(b.x, -b.half_roof, b.roof), Vector3d(b.x, b.half_roof, b.roof)},
           is_screen ? pane : paint);
  add_quad(mesh,
           {Vector3d(a.x, a.half_belt, a.sill), Vector3d(a.x, -a.half_belt, a.sill),
            Vector3d(b.x, -b.half_belt, b.sill), Vector3d(b.x, b.half_belt, b.sill)},
           paint);
}

void add_end(Mesh& mesh, const Section& s, const Surface& paint) {
  add_quad(mesh,
           {Vector3d(s.x, 0.96 * s.half_belt, s.sill), Vector3d(s.x, -0.96 * s.half_belt, s.sill),
            Vector3d(s.x, -s.half_belt, s.belt), Vector3d(s.x, s.half_belt, s.belt)},
           paint);
  add_quad(mesh,
           {Vector3d(s.x, s.half_belt, s.belt), Vector3d(s.x, -s.half_belt, s.belt),
            Vector3d(s.x, -s.half_roof, s.roof), Vector3d(s.x, s.half_roof, s.roof)},
           paint);
}

void add_wheels(Mesh& mesh, double axle_m, double half_width_m, double radius_m, Label label) {
  for (const double x : {axle_m, -axle_m}) {
    for (const double side : {1.0, -1.0}) {
      const Vector3d out(x, side * half_width_m, radius_m), in(x, side * (half_width_m - 0.2), radius_m);
      add_bar(mesh, in, out, radius_m, radius_m, 10, {Material::kRubber, 90, label});
      add_bar(mesh, out, out + Vector3d(0.0, 0.01 * side, 0.0), radius_m, 0.02, 10,
              {Material::kMetal, 140, label});
    }
  }
}

}  // namespace

Model car_model(CarShape shape, std::uint8_t shade, Label label) {
  Mesh mesh;
  const std::span<const Section> sections = sections_of(shape);
  const Surface paint{Material::kCarPaint, shade, label}, glass{Material::kGlass, 128, label};
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const bool has_cabin =
        sections[i].roof - sections[i].belt > 0.3 || sections[i - 1].roof - sections[i - 1].belt > 0.3;
    const bool is_box = shape == CarShape::kTruck && i > 2;
    add_hull(mesh, sections[i - 1], sections[i], paint, has_cabin && !is_box ? glass : paint);
  }
  add_end(mesh, sections.front(), paint);
  add_end(mesh, sections.back(), paint);
  const bool is_big = shape == CarShape::kTruck;
  const double half_width_m = sections[2].half_belt + 0.01;
  add_wheels(mesh, is_big ? 2.4 : 0.31 * (sections.front().x - sections.back().x), half_width_m,
             is_big ? 0.48 : 0.31, label);
  return finished(std::move(mesh));
}

Model person_model(Random& random, Label label) {
  Mesh mesh;
  const double h = random.between(1.6, 1.9), stride = random.between(0.1, 0.3);
  const Surface cloth{Material::kCloth, static_cast<std::uint8_t>(random.below(256)), label};
  const Surface legs{Material::kCloth, static_cast<std::uint8_t>(random.below(256)), label};
  for (const double side : {1.0, -1.0}) {
    add_bar(mesh, {side * stride, side * 0.09, 0.0}, {0.0, side * 0.1, 0.48 * h}, 0.06, 0.09, 6, legs);
    add_bar(mesh, {-side * stride, side * 0.24, 0.45 * h}, {0.0, side * 0.22, 0.8 * h}, 0.04, 0.05, 5, cloth);
  }
  add_bar(mesh, {0.0, 0.0, 0.46 * h}, {0.0, 0.0, 0.84 * h}, 0.16, 0.2, 8, cloth);
  add_bar(mesh, {0.0, 0.0, 0.84 * h}, {0.0, 0.0, 0.86 * h}, 0.2, 0.06, 8, cloth);
  add_bar(mesh, {0.0, 0.0, 0.86 * h}, {0.0, 0.0, 0.93 * h}, 0.07, 0.1, 8, cloth);
  add_bar(mesh, {0.0, 0.0, 0.93 * h}, {0.0, 0.0, h}, 0.1, 0.04, 8, cloth);
  return finished(std::move(mesh));
}

Model tree_model(Random& random, double height_m, double crown_m) {
  Mesh mesh;
  const Surface bark{Material::kBark, 128, Label::kTrunk}, leaf{Material::kLeaf, 128, Label::kVegetation};
  const double fork_m = height_m * random.between(0.28, 0.4), trunk_m = 0.018 * height_m + 0.04;
  const Vector3d fork(random.between(-0.2, 0.2), random.between(-0.2, 0.2), fork_m);
  add_bar(mesh, {0.0, 0.0, -0.3}, fork, 1.2 * trunk_m, trunk_m, 8, bark);
  add_bar(mesh, fork, {fork.x(), fork.y(), 0.85 * height_m}, trunk_m, 0.3 * trunk_m, 6, bark);
  const int limbs = 4 + random.below(4);
  for (int i = 0; i < limbs; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + random.between(0.0, 0.7)) / limbs;
    const double reach_m = 0.8 * crown_m * random.between(0.6, 1.0);
    const Vector3d end(reach_m * std::cos(angle), reach_m * std::sin(angle),
                       fork_m + (height_m - fork_m) * random.between(0.25, 0.75));
    add_bar(mesh, fork, end, 0.5 * trunk_m, 0.15 * trunk_m, 5, bark);
    // Leaves gather about the limbs' ends: crowns have gaps that one sees through.
    add_foliage(mesh, moved(end),
                {.half_m = Vector3d(0.55, 0.55, 0.5) * crown_m, .count = 130, .leaf_m = 0.2}, random, leaf);
  }
  const Vector3d middle(fork.x(), fork.y(), 0.62 * height_m);
  add_foliage(mesh, moved(middle),
              {.half_m = Vector3d(crown_m, crown_m, 0.36 * height_m), .count = 350, .leaf_m = 0.25}, random,
              leaf);
  return finished(std::move(mesh));
}

Model bush_model(Random& random, double height_m) {
  Mesh mesh;
  const int clumps = 2 + random.below(3);
  for (int i = 0; i < clumps; ++i) {
    const Vector3d at(random.between(-0.6, 0.6) * height_m, random.between(-0.6, 0.6) * height_m,
                      0.45 * height_m);
    add_foliage(mesh, moved(at),
                {.half_m = Vector3d(0.6, 0.6, 0.55) * height_m, .count = 110, .leaf_m = 0.14}, random,
                {Material::kLeaf, 120, Label::kVegetation});
  }
  return finished(std::move(mesh));
}

Model tuft_model(Random& random, double height_m) {
  Mesh mesh;
  const int blades = 25 + random.below(20);
  for (int i = 0; i < blades; ++i) {
    const double turn = random.between(-3.2, 3.2), high_m = height_m * random.between(0.6, 1.0);
    const Vector3d foot(random.between(-0.35, 0.35), random.between(-0.35, 0.35), -0.05);
    const Vector3d across(0.012 * std::cos(turn), 0.012 * std::sin(turn), 0.0);
    const Vector3d tip = foot + Vector3d(random.between(-0.3, 0.3) * high_m,
                                         random.between(-0.3, 0.3) * high_m, high_m + 0.05);
    add_triangle(mesh, foot - across, foot + across, tip, {Material::kLeaf, 140, Label::kVegetation});
  }
  return finished(std::move(mesh));
}

}  // namespace pago::simulator
