// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "height_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pago::ground {
namespace {

// As in the authors' code.
constexpr double kMinRange_m = 2.7, kMinUprightness = 0.707;
constexpr GrowthRule kGrowth{
    .lowest_points = 20, .seed_height_m = 0.5, .ground_thickness_m = 0.125, .iterations = 3};
constexpr std::size_t kMinPoints = 10;

/// Where a value's interval begins or ends.
struct End {
  double at = 0.0;
  bool is_start = false;
  std::uint16_t value = 0;
};

/// Sums over the values whose intervals hold the point that the sweep has come to.
struct Active {
  double count = 0.0, weight = 0.0, weighted = 0.0, sum = 0.0, squares = 0.0, reach_outside = 0.0;

  void change(const BoundedValue& v, double by) noexcept {
    count += by;
    weight += by * v.weight;
    weighted += by * v.weight * v.value;
    sum += by * v.value;
    squares += by * v.value * v.value;
    reach_outside -= by * v.reach;
  }
  double mean() const noexcept { return weighted / weight; }
  double cost() const noexcept {
    const double x = mean();
    return count * x * x + squares - 2.0 * x * sum + reach_outside;
  }
};

std::vector<PolarBins> grids(const HeightEstimateConfig& c, std::size_t radii, std::uint32_t max_returns) {
  std::vector<PolarBins> bins;
  double radius_m = c.max_range_m;
  for (std::size_t i = 0; i < radii; ++i, radius_m *= 2.0)
    bins.emplace_back(PolarGrid(std::array{PolarZone{kMinRange_m, 1, c.sectors}}, radius_m), max_returns);
  return bins;
}

}  // namespace

Agreement consensus(std::span<const BoundedValue> values) noexcept {
  std::array<End, 2 * kMaxValues> ends;
  std::size_t num_ends = 0;
  Active active;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const BoundedValue& v = values[i];
    ends[num_ends++] = {v.value - v.reach, true, static_cast<std::uint16_t>(i)};
    ends[num_ends++] = {v.value + v.reach, false, static_cast<std::uint16_t>(i)};
    active.reach_outside += v.reach;
  }
  // Intervals that touch overlap; then by number, so that the order is the same everywhere.
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(num_ends),
            [](const End& a, const End& b) {
              if (a.at != b.at) return a.at < b.at;
              return a.is_start != b.is_start ? a.is_start : a.value < b.value;
            });
  Agreement best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < num_ends; ++k) {
    active.change(values[ends[k].value], ends[k].is_start ? 1.0 : -1.0);
    if (!ends[k].is_start || !(active.weight > 0.0) || !(active.cost() < least)) continue;
    least = active.cost();
    best = {active.mean(), static_cast<std::size_t>(std::lround(active.count))};
  }
  return best;
}

HeightEstimate::HeightEstimate(const HeightEstimateConfig& config,
                               const Mount& mount,
                               std::uint32_t max_returns)
    : config_(config),
      level_(mount, max_returns),
      bins_(grids(config, kRadii, max_returns)),
      grow_(kGrowth, max_returns) {}

std::optional<double> HeightEstimate::operator()(const Sweep& sweep) noexcept {
  const Coordinates returns = level_(sweep, 0, sweep.size);
  for (PolarBins& bins : bins_)
    if (const auto height_m = estimate(returns, sweep, bins)) return height_m;
  return std::nullopt;
}

std::optional<double> HeightEstimate::estimate(const Coordinates& returns,
                                               const Sweep& sweep,
                                               PolarBins& bins) noexcept {
  bins.begin();
  bins.locate(returns, sweep.size, -std::numeric_limits<float>::max());
  bins.sort_rest(returns);
  std::array<BoundedValue, kMaxValues> planes;
  std::size_t num_planes = 0;
  for (int bin = 0; bin < bins.grid().num_bins(); ++bin) {
    const Points points = bins.points(bin);
    const PolarCell& cell = bins.grid().cell(bin);
    if (points.size() < kMinPoints) continue;
    const PlaneFit plane = grow_(points, PlaneGrower::kNoFloor, cell.centre_x_m, cell.centre_y_m);
    if (!plane.is_valid || plane.normal.z() <= kMinUprightness || plane.mean.z() >= 0.0) continue;
    const auto& w = plane.variance;
    const double linearity = (w[2] - w[1]) / w[2], planarity = (w[1] - w[0]) / w[2];
    if (linearity >= config_.max_linearity) continue;
    const double bound_m = config_.noise_bound_m;
    planes[num_planes++] = {plane.mean.z(), bound_m * linearity, planarity * planarity / (bound_m * bound_m)};
  }
  const Agreement ground = consensus({planes.data(), num_planes});
  if (4 * ground.count < static_cast<std::size_t>(config_.sectors)) return std::nullopt;
  return -ground.value;
}

}  // namespace pago::ground
