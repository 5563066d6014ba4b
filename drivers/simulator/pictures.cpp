// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pago/output/picture.hpp"
#include "pago/output/text_file.hpp"
#include "surface.hpp"

namespace pago::simulator {
namespace {

using output::Colour;
using output::Picture;

/// As SemanticKITTI's own viewer has them, brighter where the ground is black.
Colour colour_of(std::uint32_t label) {
  switch (static_cast<Label>(label)) {
    case Label::kRoad:
      return {128, 64, 128};
    case Label::kParking:
      return {250, 170, 250};
    case Label::kSidewalk:
      return {200, 40, 190};
    case Label::kOtherGround:
      return {175, 60, 75};
    case Label::kLaneMarking:
      return {255, 255, 255};
    case Label::kTerrain:
      return {152, 230, 120};
    case Label::kVegetation:
      return {30, 150, 30};
    case Label::kTrunk:
      return {160, 90, 40};
    case Label::kBuilding:
      return {255, 200, 60};
    case Label::kOtherStructure:
      return {200, 170, 130};
    case Label::kFence:
      return {255, 120, 80};
    case Label::kCar:
    case Label::kTruck:
      return {90, 130, 245};
    case Label::kMovingCar:
    case Label::kMovingTruck:
      return {255, 30, 30};
    case Label::kPerson:
    case Label::kMovingPerson:
      return {255, 150, 0};
    case Label::kPole:
      return {225, 225, 225};
    case Label::kTrafficSign:
      return {255, 255, 0};
    case Label::kOtherObject:
      return {0, 220, 220};
    case Label::kUnlabelled:
    case Label::kOutlier:
      break;
  }
  return {110, 110, 110};
}

double range_m(const LabelledPoint& p) {
  return double{std::sqrt(p.x_m * p.x_m + p.y_m * p.y_m + p.z_m * p.z_m)};
}

/// Near red, far blue; equal steps for equal ratios.
Colour colour_of_range(double range) {
  const double share = std::clamp(std::log(range / 2.0) / std::log(60.0), 0.0, 1.0);
  const auto level = [&](double centre) {
    return static_cast<std::uint8_t>(255.0 * std::clamp(1.5 - 3.0 * std::abs(share - centre), 0.1, 1.0));
  };
  return {level(0.1), level(0.45), level(0.85)};
}

void draw_bird(const LabelledRings& rings, const std::filesystem::path& file) {
  constexpr int kSize = 800;
  constexpr double kHalf_m = 50.0;
  Picture picture(kSize, kSize);
  // Lower rings first, so that what stands high covers the ground.
  for (const std::vector<LabelledPoint>& ring : rings) {
    for (const LabelledPoint& p : ring) {
      picture.set(static_cast<int>(std::floor((1.0 - double{p.y_m} / kHalf_m) * kSize / 2)),
                  static_cast<int>(std::floor((1.0 - double{p.x_m} / kHalf_m) * kSize / 2)),
                  colour_of(p.label));
    }
  }
  picture.save(file);
}

template <typename ColourOf>
void draw_view(const LabelledRings& rings, ColourOf colour_of_point, const std::filesystem::path& file) {
  constexpr int kWidth = 1000, kRows = 3;  // pixels for a ring
  Picture picture(kWidth, kRows * hdl64::kLasers);
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    for (const LabelledPoint& p : rings[ring]) {
      const double from_rear = std::numbers::pi - double{p.turn_rad};  // clockwise, as the head turns
      const double share =
          (from_rear < 0.0 ? from_rear + 2.0 * std::numbers::pi : from_rear) / (2.0 * std::numbers::pi);
      for (int row = 0; row < kRows; ++row)
        picture.set(static_cast<int>(share * kWidth),
                    kRows * (hdl64::kLasers - 1 - static_cast<int>(ring)) + row, colour_of_point(p));
    }
  }
  picture.save(file);
}

}  // namespace

void draw_scan(const LabelledRings& rings, const std::filesystem::path& folder) {
  output::make_folders(folder);
  draw_bird(rings, folder / "bird.png");
  draw_view(
      rings, [](const LabelledPoint& p) { return colour_of(p.label); }, folder / "classes.png");
  draw_view(
      rings, [](const LabelledPoint& p) { return colour_of_range(range_m(p)); }, folder / "ranges.png");
  const auto grey = [](const LabelledPoint& p) {
    const auto level = static_cast<std::uint8_t>(std::lround(255.0F * p.intensity));
    return Colour{level, level, level};
  };
  draw_view(rings, grey, folder / "intensities.png");
}

}  // namespace pago::simulator
