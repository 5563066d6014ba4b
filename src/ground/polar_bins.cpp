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
      cells_.push_back({zone_index, first_ring + ring, static_cast<float>(range_m * std::cos(azimuth_rad)),
                        static_cast<float>(range_m * std::sin(azimuth_rad))});
    }
  }
  if (num_bins() > kMaxBins) throw Error("polar grid", "has more than 65,534 bins");
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
      bin_of_(max_returns),
      next_(static_cast<std::size_t>(grid_.num_bins()) + 1),
      begin_(static_cast<std::size_t>(grid_.num_bins()) + 2),
      x_m_(max_returns),
      y_m_(max_returns),
      z_m_(max_returns) {}

void PolarBins::locate(const Coordinates& returns, std::uint32_t until, float min_z_m) noexcept {
  if (until <= located_) return;
  grid_.locate(returns, located_, until, min_z_m, bin_of_.data());
  located_ = until;
}

void PolarBins::group(const Coordinates& returns) noexcept {
  std::fill(next_.begin(), next_.end(), 0U);
  for (const std::uint16_t bin : bin_of_.first(located_)) ++next_[bin];

  std::uint32_t sum = 0;
  for (std::size_t bin = 0; bin < next_.size(); ++bin) {
    begin_[bin] = sum;
    sum += next_[bin];
    next_[bin] = begin_[bin];
  }
  begin_[next_.size()] = sum;

  for (std::uint32_t i = 0; i < located_; ++i) {
    const std::uint32_t to = next_[bin_of_[i]]++;
    x_m_[to] = returns.x_m[i];
    y_m_[to] = returns.y_m[i];
    z_m_[to] = returns.z_m[i];
  }
}

BinPoints PolarBins::points(int bin) const noexcept {
  const std::size_t b = static_cast<std::size_t>(bin);
  const std::size_t begin = begin_[b];
  const std::size_t size = begin_[b + 1] - begin;
  return {{x_m_.data() + begin, size}, {y_m_.data() + begin, size}, {z_m_.data() + begin, size}};
}

}  // namespace pago::ground
