// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "polar_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atan2_turns.hpp"
#include "pago/core/error.hpp"

namespace pago::ground {
namespace {

/// From the x axis to the left, in turns, [0, 1].
inline float azimuth_turns(float x, float y) noexcept {
  const float turns = atan2_turns(y, x);
  return turns < 0.0F ? turns + 1.0F : turns;
}

}  // namespace

PolarGrid::PolarGrid(std::span<const PolarZone> zones, double upper_m)
    : upper_m_(static_cast<float>(upper_m)) {
  if (zones.empty() || zones.size() > kMaxZones) throw Error("polar grid", "must have one to four zones");
  // A zone that is not there begins nowhere.
  zones_.fill({std::numeric_limits<float>::infinity(), 0.0F, 0, 1, 0});
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const double end_m = i + 1 < zones.size() ? zones[i + 1].lower_m : upper_m;
    add_cells(zones[i], static_cast<int>(i), end_m);
  }
}

void PolarGrid::add_cells(const PolarZone& zone, int zone_index, double upper_m) {
  if (!(zone.lower_m >= 0.0 && zone.lower_m < upper_m))
    throw Error("polar grid", "zone bounds must rise from 0");
  if (zone.rings < 1 || zone.sectors < 1) throw Error("polar grid", "a zone needs rings and sectors");
  const double ring_width_m = (upper_m - zone.lower_m) / zone.rings;
  const double sector_rad = 2.0 * std::numbers::pi / zone.sectors;
  zones_[static_cast<std::size_t>(zone_index)] = {static_cast<float>(zone.lower_m),
                                                  static_cast<float>(1.0 / ring_width_m), zone.rings - 1,
                                                  zone.sectors, num_bins()};
  const int first_ring = cells_.empty() ? 0 : cells_.back().ring + 1;
  for (int ring = 0; ring < zone.rings; ++ring) {
    const double range_m = zone.lower_m + (ring + 0.5) * ring_width_m;
    for (int sector = 0; sector < zone.sectors; ++sector) {
      const double azimuth_rad = (sector + 0.5) * sector_rad;
      cells_.push_back({.zone = zone_index,
                        .ring = first_ring + ring,
                        .right_turns = static_cast<float>(sector) / static_cast<float>(zone.sectors),
                        .left_turns = static_cast<float>(sector + 1) / static_cast<float>(zone.sectors),
                        .centre_x_m = static_cast<float>(range_m * std::cos(azimuth_rad)),
                        .centre_y_m = static_cast<float>(range_m * std::sin(azimuth_rad))});
    }
  }
  if (num_bins() > BinSort::kMaxBins)
    throw Error("polar grid", "has " + std::to_string(num_bins()) + " bins", "up to 65,534 can be numbered");
}

void PolarGrid::locate(const Coordinates& returns,
                       std::uint32_t from,
                       std::uint32_t until,
                       float min_z_m,
                       std::uint16_t* bin_of) const noexcept {
  constexpr float kMaxFinite = std::numeric_limits<float>::max();
  const std::array<Zone, kMaxZones> zones = zones_;
  const float upper_m = upper_m_;
  const auto outside = num_bins();
#pragma omp simd
  for (std::uint32_t i = from; i < until; ++i) {
    const float x = returns.x_m[i];
    const float y = returns.y_m[i];
    const float z = returns.z_m[i];
    const float range_m = std::sqrt(x * x + y * y);
    // False for NaN in any coordinate. & instead of &&: no branches in here.
    const bool is_inside =
        (range_m > zones[0].lower_m) & (range_m <= upper_m) & (z >= min_z_m) & (z <= kMaxFinite);
    const float r = is_inside ? range_m : zones[0].lower_m;
    const float turns = is_inside ? azimuth_turns(x, y) : 0.0F;

    // Scalars, not a Zone: the compiler keeps a struct in memory and gives up on the vector loop.
    float lower_m = zones[0].lower_m, rings_per_m = zones[0].rings_per_m;
    std::int32_t last_ring = zones[0].last_ring, sectors = zones[0].sectors, first_bin = zones[0].first_bin;
    for (std::size_t k = 1; k < kMaxZones; ++k) {
      const bool is_beyond = r >= zones[k].lower_m;
      lower_m = is_beyond ? zones[k].lower_m : lower_m;
      rings_per_m = is_beyond ? zones[k].rings_per_m : rings_per_m;
      last_ring = is_beyond ? zones[k].last_ring : last_ring;
      sectors = is_beyond ? zones[k].sectors : sectors;
      first_bin = is_beyond ? zones[k].first_bin : first_bin;
    }
    // Rounding may reach the upper bounds.
    const auto ring = static_cast<std::int32_t>((r - lower_m) * rings_per_m);
    const auto sector = static_cast<std::int32_t>(turns * static_cast<float>(sectors));
    const std::int32_t bin = first_bin + (ring < last_ring ? ring : last_ring) * sectors +
                             (sector < sectors ? sector : sectors - 1);
    bin_of[i] = static_cast<std::uint16_t>(is_inside ? bin : outside);
  }
}

PolarBins::PolarBins(PolarGrid grid, std::uint32_t max_returns)
    : grid_(std::move(grid)),
      sorted_(grid_.num_bins(), max_returns),
      swept_(static_cast<std::size_t>(grid_.num_bins())) {}

void PolarBins::locate(const Coordinates& returns, std::uint32_t until, float min_z_m) noexcept {
  if (until <= located()) return;
  grid_.locate(returns, located(), until, min_z_m, sorted_.bin_of());
  sorted_.note(until);
}

void PolarBins::sort_swept(const Coordinates& returns, const SweptArc& arc) noexcept {
  swept_.clear();
  for (int bin = 0; bin < grid_.num_bins(); ++bin) {
    const PolarCell& cell = grid_.cell(bin);
    if (!sorted_.is_sorted(bin) && arc.holds(cell.right_turns, cell.left_turns))
      swept_.push_back(static_cast<std::uint16_t>(bin));
  }
  sorted_.sort(returns, swept_.view());
}

}  // namespace pago::ground
