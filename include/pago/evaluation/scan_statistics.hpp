// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pago/core/sweep.hpp"

/// What a drive's sweeps look like, from the sweeps alone: no truth, no labels. So real drives can be set
/// beside simulated ones (`pago compare`). [set-up] everything here allocates.
namespace pago::evaluation {

/// Equal bins from 0; what is beyond the last is not counted.
struct Bins {
  std::size_t count;
  double width;
  /// Index of the bin; `count` when there is none.
  constexpr std::size_t of(double value) const noexcept {
    return value >= 0.0 && value < width * static_cast<double>(count)
               ? static_cast<std::size_t>(value / width)
               : count;
  }
  constexpr double from(std::size_t bin) const noexcept { return width * static_cast<double>(bin); }
};
inline constexpr Bins kRangeBins{60, 2.0};       ///< m
inline constexpr Bins kPatchBins{5, 5.0};        ///< m
inline constexpr Bins kIncidenceBins{9, 10.0};   ///< degrees; 0 square on
inline constexpr Bins kNoiseBins{400, 0.0005};   ///< m
inline constexpr Bins kApartBins{1000, 0.0005};  ///< m

/// What a laser's returns along a surface say of it; see add_surfaces().
struct SurfaceCounts {
  std::uint64_t had = 0, lost = 0;                           ///< firings with and without a return
  std::array<std::uint64_t, kNoiseBins.count> deviations{};  ///< of a range from its neighbours'
};

/// Counts over sweeps; everything else follows from them.
struct ScanStatistics {
  std::uint64_t sweeps = 0, returns = 0, ground = 0;
  std::array<std::uint64_t, kNumRings> of_ring{};  ///< returns; 0 the lowest
  std::array<std::uint64_t, kRangeBins.count> of_range{}, ground_of_range{};
  std::array<std::uint64_t, 256> ground_intensity{}, other_intensity{};
  std::array<std::vector<float>, kPatchBins.count> patch_rms_m;  ///< by the range of the patch
  std::array<SurfaceCounts, kIncidenceBins.count> surfaces;
  std::array<std::uint64_t, kApartBins.count> apart{};  ///< returns by their distance; see add_overlap()
  std::uint64_t unmatched = 0;                          ///< returns where the sweep before saw no surface
};

/// The returns of one sweep, with its ground mask: rings, ranges, intensities, ground. Of a dual return the
/// strongest counts; points at 0, 0, 0 are no returns.
void add_returns(const Sweep& sweep, ScanStatistics& statistics);

/// How flat ground is. Ground returns are sorted into squares whose side is a fifth of the range (1 m below
/// 5 m, 5 m at 25 m); those with 12 returns or more of three rings or more get a plane by least squares. The
/// rms distance from it, as that of a plane of known noise (n - 3 degrees of freedom), is the square's
/// residual: noise, laser against laser, and the ground's own roughness.
void add_ground_patches(const Sweep& sweep, ScanStatistics& statistics);

/// What becomes of firings at surfaces. A firing counts where the last return before it and the next one
/// after it on the same ring are no more than five firings apart and lie, with six more returns 0.2 m or more
/// around, on one plane (within 6 cm); the angle between beam and normal is the incidence. Missing firings
/// are told by the azimuth between returns, in steps of the sweep's median. Where all three firings returned,
/// the middle's range minus that of a straight line through the other two is a deviation.
void add_surfaces(const Sweep& sweep, ScanStatistics& statistics);

/// A sweep's points at rest, in metres.
using Cloud = std::vector<Eigen::Vector3f>;

/// How well a sweep lies on the one before it, both in the same frame. Cubes of 0.5 m in which the earlier
/// one has 8 points or more that are flat (least extent below a third of the middle one) have a plane; each
/// point of the later one in them counts with its distance from that plane.
void add_overlap(const Cloud& earlier, const Cloud& later, ScanStatistics& statistics);

/// A drive in a few numbers; NaN where nothing was counted.
struct ScanFigures {
  double returns_per_sweep = 0.0;
  double lowest_rings_percent = 0.0;  ///< of the returns: the ten lowest rings', which a roof may hide
  double ground_percent = 0.0;        ///< of the returns
  double median_range_m = 0.0;
  double beyond_30_percent = 0.0;        ///< of the returns: more than 30 m away
  double near_residual_m = 0.0;          ///< median over ground patches from 5 to 10 m
  double far_residual_m = 0.0;           ///< from 15 to 20 m
  double range_noise_m = 0.0;            ///< robust standard deviation of a range, incidence below 60 degrees
  double dropout_percent = 0.0;          ///< at incidences below 60 degrees
  double grazing_dropout_percent = 0.0;  ///< from 70 to 80 degrees
  double ground_intensity = 0.0;         ///< median, 0 to 255
  double other_intensity = 0.0;          ///< median, 0 to 255
  double overlap_m = 0.0;                ///< median distance from the surfaces of the sweep before
  double unmatched_percent = 0.0;        ///< of the returns: where the sweep before saw no surface
};
ScanFigures figures_of(const ScanStatistics& statistics);

/// Robust standard deviation of a range from such deviations; NaN for fewer than 50.
double range_noise_m(const SurfaceCounts& counts);
/// NaN for fewer than 50 firings.
double dropout_percent(const SurfaceCounts& counts);
double median_value(std::vector<float> values);

/// What is compared.
struct ScannedDrive {
  std::string source;
  ScanStatistics statistics;
};
/// A figure as reports show it.
struct ScanFigure {
  const char* name;  ///< with its unit
  const char* key;   ///< of JSON, with its unit
  double ScanFigures::*value;
  double scale;  ///< to that unit
  int decimals;
};
const std::vector<ScanFigure>& scan_figures();

/// A row per figure, a column per drive. Ends with a line feed.
std::string scan_table(const std::vector<ScannedDrive>& drives);
/// Figures and curves of every drive.
std::string scan_json(const std::vector<ScannedDrive>& drives);

}  // namespace pago::evaluation
