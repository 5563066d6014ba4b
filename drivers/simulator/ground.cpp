// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pago::simulator {
namespace {

// What the seed is used for.
enum : std::uint64_t { kKerb = 100, kDriveway, kRoad, kYard, kRelief, kShade, kBump, kDitch, kBank };

constexpr std::size_t kFarStride = 10;  // street points; 20 m
// Within the first distance from a street's middle the land follows the streets near by, beyond the second
// the mean of all of them.
constexpr double kNear_m = 10.0, kFar_m = 45.0;

double cubed(double x) {
  return x * x * x;
}

}  // namespace

Ground::Ground(StreetMap streets, const GroundStyle& style, std::uint64_t seed)
    : streets_(std::move(streets)), style_(style), seed_(seed) {
  for (std::size_t i = 0; i < streets_.points().size(); ++i) {
    const StreetPoint& point = streets_.points()[i];
    if (i % kFarStride == 0) far_points_.emplace_back(point.at.x(), point.at.y(), point.z_m);
    const auto street = static_cast<std::size_t>(point.street);
    if (street_length_m_.size() <= street) street_length_m_.resize(street + 1, 0.0);
    street_length_m_[street] = std::max(street_length_m_[street], point.from_start_m);
  }
}

Ground::Spot Ground::spot(const Eigen::Vector2d& at) const noexcept {
  Spot result;
  result.at = at;
  result.street.edge_m = StreetMap::kReach_m;
  double sum = 0.0, weights = 0.0, nearest_sq = StreetMap::kReach_m * StreetMap::kReach_m;
  for (const std::uint32_t i : streets_.around(at)) {
    const StreetPoint& point = streets_.points()[i];
    const StreetPlace place = StreetMap::relate(point, at);
    if (place.edge_m < result.street.edge_m) result.street = place;
    const double distance_sq = place.along_m * place.along_m + place.offset_m * place.offset_m;
    nearest_sq = std::min(nearest_sq, distance_sq);
    // A street's own plane holds on it and a little beside it.
    const double weight = 1.0 / cubed(distance_sq + 0.5);
    sum += weight * (point.z_m + point.grade * std::clamp(place.along_m, -4.0, 4.0) +
                     point.cross_grade * std::clamp(place.offset_m, -8.0, 8.0));
    weights += weight;
  }
  const double share = blend(kNear_m, kFar_m, std::sqrt(nearest_sq));
  if (share < 1.0) result.base_m += (1.0 - share) * sum / weights;
  if (share > 0.0) result.base_m += share * far_height_m(at);
  return result;
}

double Ground::far_height_m(const Eigen::Vector2d& at) const noexcept {
  double sum = 0.0, weights = 0.0;
  for (const Eigen::Vector3d& point : far_points_) {
    const double closeness = 1.0 / ((point.head<2>() - at).squaredNorm() + 900.0);
    sum += closeness * closeness * point.z();
    weights += closeness * closeness;
  }
  return sum / weights + style_.relief_m * noise(hash(seed_, kRelief), at.x(), at.y(), 60.0);
}

// A table of 4 m with rounded ramps, 7 cm high, well away from the street's ends.
double Ground::speed_bump_m(const StreetPlace& street) const noexcept {
  if (style_.speed_bumps <= 0.0 || street.point == nullptr) return 0.0;
  constexpr double kApart_m = 80.0, kHalf_m = 2.0, kHeight_m = 0.07, kFromEnds_m = 25.0;
  const double s = street.point->from_start_m + street.along_m;
  const double slot = std::floor(s / kApart_m);
  Random random(seed_, kBump, street.point->street, static_cast<std::int64_t>(slot));
  if (!random.chance(style_.speed_bumps)) return 0.0;
  const double middle = kApart_m * (slot + random.between(0.2, 0.8));
  const double length_m = street_length_m_[static_cast<std::size_t>(street.point->street)];
  if (middle < kFromEnds_m || middle > length_m - kFromEnds_m) return 0.0;
  return kHeight_m * (1.0 - blend(0.4 * kHalf_m, kHalf_m, std::abs(s - middle)));
}

// Long waves run under road and land alike.
double Ground::waves_m(const Eigen::Vector2d& at) const noexcept {
  return style_.road_roughness_m * (2.0 * noise(hash(seed_, kRoad, 1), at.x(), at.y(), 5.0) +
                                    4.0 * noise(hash(seed_, kRoad, 2), at.x(), at.y(), 17.0));
}

double Ground::road_height_m(const Spot& spot) const noexcept {
  const double rough_m = style_.road_roughness_m * noise(hash(seed_, kRoad), spot.at.x(), spot.at.y(), 1.5);
  return spot.base_m + waves_m(spot.at) + rough_m + speed_bump_m(spot.street);
}

// Ditches and banks come and go along a road, and differ between its sides: so they are looked up some way
// beside it.
double Ground::verge_m(const Spot& spot) const noexcept {
  if ((style_.ditch_m <= 0.0 && style_.bank_m <= 0.0) || spot.street.point == nullptr) return 0.0;
  constexpr double kAside_m = 70.0;
  const StreetPoint& point = *spot.street.point;
  const double edge_m = spot.street.edge_m;
  const Eigen::Vector2d key = point.at + spot.street.along_m * point.along +
                              std::copysign(kAside_m, spot.street.offset_m) * point.left();
  const double ditch = blend(-0.2, 0.2, noise(hash(seed_, kDitch), key.x(), key.y(), 45.0)) *
                       blend(1.0, 2.2, edge_m) * (1.0 - blend(2.6, 4.0, edge_m));
  const double bank = noise(hash(seed_, kBank), key.x(), key.y(), 60.0) * blend(2.0, 9.0, edge_m) *
                      (1.0 - blend(14.0, 30.0, edge_m));
  return style_.bank_m * bank - style_.ditch_m * ditch;
}

double Ground::land_height_m(const Spot& spot) const noexcept {
  const Eigen::Vector2d& at = spot.at;
  double kerb_m = style_.kerb_low_m + (style_.kerb_high_m - style_.kerb_low_m) *
                                          (0.5 + 0.5 * noise(hash(seed_, kKerb), at.x(), at.y(), 40.0));
  // Lowered where cars drive over it.
  const double driveway = noise(hash(seed_, kDriveway), at.x(), at.y(), 9.0);
  kerb_m -= 0.8 * kerb_m * blend(0.55, 0.75, driveway) *
            (1.0 - blend(0.6 * style_.sidewalk_m, style_.sidewalk_m, spot.street.edge_m));
  const double bumps_m = style_.yard_bump_m * (noise(hash(seed_, kYard), at.x(), at.y(), 2.0) +
                                               2.0 * noise(hash(seed_, kYard, 1), at.x(), at.y(), 7.0));
  const double wildness = blend(style_.sidewalk_m, style_.sidewalk_m + 2.0, spot.street.edge_m);
  return spot.base_m + waves_m(at) + kerb_m + verge_m(spot) + wildness * bumps_m;
}

Surface Ground::surface(const Spot& spot) const noexcept {
  const Eigen::Vector2d& at = spot.at;
  const auto shade = [&](double size_m, double spread) {
    const double value = 128.0 + spread * noise(hash(seed_, kShade), at.x(), at.y(), size_m);
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  };
  const auto shaded = [&](Surface surface, double size_m, double spread) {
    surface.shade = shade(size_m, spread);
    return surface;
  };
  if (spot.is_on_road()) return shaded(style_.road, 15.0, 60.0);
  if (spot.street.edge_m < style_.sidewalk_m) return shaded(style_.side, 4.0, 60.0);
  return shaded(style_.yard, 6.0, 90.0);
}

}  // namespace pago::simulator
