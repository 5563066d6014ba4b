// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/scan_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "no_value.hpp"

namespace pago::evaluation {
namespace {

using Counts = std::span<const std::uint64_t>;

double total(Counts counts) {
  return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
}

double percent(double part, double whole) {
  return whole > 0.0 ? 100.0 * part / whole : kNoValue;
}

/// Of a histogram, in bins: 2.5 is the middle of the third.
double median_bin(Counts counts) {
  const double half = 0.5 * total(counts);
  double below = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto n = static_cast<double>(counts[i]);
    if (n > 0.0 && below + n >= half) return static_cast<double>(i) + (half - below) / n;
    below += n;
  }
  return kNoValue;
}

/// Of values that are whole numbers.
double median_number(Counts counts) {
  return std::floor(median_bin(counts));
}

SurfaceCounts between_deg(const ScanStatistics& statistics, std::size_t from_deg, std::size_t to_deg) {
  SurfaceCounts sum;
  const auto width = static_cast<std::size_t>(kIncidenceBins.width);
  for (std::size_t bin = from_deg / width; bin < to_deg / width; ++bin) {
    const SurfaceCounts& counts = statistics.surfaces[bin];
    sum.had += counts.had;
    sum.lost += counts.lost;
    for (std::size_t i = 0; i < sum.deviations.size(); ++i) sum.deviations[i] += counts.deviations[i];
  }
  return sum;
}

constexpr double kFewestCounts = 50.0;

}  // namespace

double range_noise_m(const SurfaceCounts& counts) {
  if (total(counts.deviations) < kFewestCounts) return kNoValue;
  // Half of a normal distribution lies within 0.6745 deviations; the mean of two neighbours adds a half to
  // the variance.
  return median_bin(counts.deviations) * kNoiseBins.width / 0.6745 / std::sqrt(1.5);
}

double dropout_percent(const SurfaceCounts& counts) {
  const auto firings = static_cast<double>(counts.had + counts.lost);
  return firings < kFewestCounts ? kNoValue : percent(static_cast<double>(counts.lost), firings);
}

double median_value(std::vector<float> values) {
  if (values.empty()) return kNoValue;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return double{*middle};
}

void add_returns(const Sweep& sweep, ScanStatistics& statistics) {
  ++statistics.sweeps;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const double range_m = Eigen::Vector3d(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).norm();
    if (range_m == 0.0 || (sweep.echo[i] & kNotStrongest) != 0) continue;
    const bool is_ground = sweep.ground[i] == kGround;
    ++statistics.returns;
    ++statistics.of_ring[sweep.ring[i]];
    ++(is_ground ? statistics.ground_intensity : statistics.other_intensity)[sweep.intensity[i]];
    statistics.ground += is_ground ? 1U : 0U;
    const std::size_t bin = kRangeBins.of(range_m);
    if (bin == kRangeBins.count) continue;
    ++statistics.of_range[bin];
    statistics.ground_of_range[bin] += is_ground ? 1U : 0U;
  }
}

ScanFigures figures_of(const ScanStatistics& s) {
  constexpr std::size_t kLowest = 10, kFar_m = 30;
  const auto returns = static_cast<double>(s.returns);
  const SurfaceCounts plain = between_deg(s, 0, 60);
  const double on_surfaces = total(s.apart);
  ScanFigures f;
  f.returns_per_sweep = s.sweeps > 0 ? returns / static_cast<double>(s.sweeps) : kNoValue;
  f.lowest_rings_percent = percent(total(Counts(s.of_ring).first(kLowest)), returns);
  f.ground_percent = percent(static_cast<double>(s.ground), returns);
  f.median_range_m = median_bin(s.of_range) * kRangeBins.width;
  f.beyond_30_percent =
      percent(returns - total(Counts(s.of_range).first(kRangeBins.of(double{kFar_m}))), returns);
  f.near_residual_m = median_value(s.patch_rms_m[kPatchBins.of(5.0)]);
  f.far_residual_m = median_value(s.patch_rms_m[kPatchBins.of(15.0)]);
  f.range_noise_m = range_noise_m(plain);
  f.dropout_percent = dropout_percent(plain);
  f.grazing_dropout_percent = dropout_percent(between_deg(s, 70, 80));
  f.ground_intensity = median_number(s.ground_intensity);
  f.other_intensity = median_number(s.other_intensity);
  f.overlap_m = median_bin(s.apart) * kApartBins.width;
  f.unmatched_percent =
      percent(static_cast<double>(s.unmatched), static_cast<double>(s.unmatched) + on_surfaces);
  return f;
}

}  // namespace pago::evaluation
