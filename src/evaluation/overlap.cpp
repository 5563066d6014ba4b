// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "cell_planes.hpp"
#include "pago/evaluation/scan_statistics.hpp"

namespace pago::evaluation {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kFewestOnSurface = 8.0;
constexpr double kFlatness = 1.0 / 3.0;  // of extents

std::optional<Plane> surface_of(const CellSums& sums) {
  if (sums.n < kFewestOnSurface) return std::nullopt;
  const Plane plane = sums.plane();
  if (plane.variances[0] > kFlatness * kFlatness * plane.variances[1]) return std::nullopt;
  return plane;
}

}  // namespace

void add_overlap(const Cloud& earlier, const Cloud& later, ScanStatistics& statistics) {
  std::unordered_map<std::uint64_t, CellSums> cells;
  for (const Eigen::Vector3f& point : earlier) {
    const Eigen::Vector3d p = point.cast<double>();
    cells[cell_key(p, kCell_m)].add(p);
  }
  std::unordered_map<std::uint64_t, Plane> surfaces;
  for (const auto& [key, sums] : cells)
    if (const auto plane = surface_of(sums)) surfaces.emplace(key, *plane);
  for (const Eigen::Vector3f& point : later) {
    const Eigen::Vector3d p = point.cast<double>();
    const auto found = surfaces.find(cell_key(p, kCell_m));
    if (found == surfaces.end()) {
      ++statistics.unmatched;
    } else if (const std::size_t bin = kApartBins.of(found->second.distance_m(p)); bin < kApartBins.count) {
      ++statistics.apart[bin];
    }
  }
}

}  // namespace pago::evaluation
