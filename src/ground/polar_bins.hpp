// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "level.hpp"

namespace pago::ground {

/// An annulus about the sensor, cut into equally wide rings and sectors. It ends where the next zone begins.
struct PolarZone {
  double lower_m = 0.0;
  int rings = 1, sectors = 1;
};

/// Where a bin lies.
struct PolarCell {
  int zone = 0;
  int ring = 0;  ///< counted from the innermost of all zones
  float centre_x_m = 0.0F, centre_y_m = 0.0F;
};

/// Up to four zones (Patchwork's concentric zone model; a uniform polar grid is one zone). Bins are numbered
/// zone by zone, in it ring by ring outwards, in it sector by sector from the x axis to the left.
class PolarGrid {
 public:
  static constexpr std::size_t kMaxZones = 4;
  static constexpr int kMaxBins = 65534;

  /// [set-up] Covers lower_m of the first zone < range <= upper_m. Throws Error unless the bounds rise and
  /// there are at most kMaxBins.
  PolarGrid(std::span<const PolarZone> zones, double upper_m);

  int num_bins() const noexcept { return static_cast<int>(cells_.size()); }
  const PolarCell& cell(int bin) const noexcept { return cells_[static_cast<std::size_t>(bin)]; }

  /// The bin of each of the returns [from, until), num_bins() for those outside, lower than `min_z_m` or not
  /// finite. Vectorised: azimuths are within 3e-7 rad.
  void locate(const Coordinates& returns,
              std::uint32_t from,
              std::uint32_t until,
              float min_z_m,
              std::uint16_t* bin_of) const noexcept;

 private:
  struct Zone {
    float lower_m, rings_per_m;
    std::int32_t last_ring, sectors, first_bin;
  };
  void add_cells(const PolarZone& zone, int zone_index, double upper_m);

  std::array<Zone, kMaxZones> zones_{};
  float upper_m_;
  std::vector<PolarCell> cells_;
};

/// Returns of one bin, contiguous, in the sweep's order.
struct BinPoints {
  std::span<const float> x_m, y_m, z_m;
  std::size_t size() const noexcept { return z_m.size(); }
};

/// The returns of a sweep sorted into the bins of a grid by one counting sort. Locating may go along with the
/// sweep's parts; grouping needs them all. [front thread] everything but the constructor; real-time safe.
class PolarBins {
 public:
  /// [set-up] allocates.
  PolarBins(PolarGrid grid, std::uint32_t max_returns);

  const PolarGrid& grid() const noexcept { return grid_; }
  void clear() noexcept { located_ = 0; }
  std::uint32_t located() const noexcept { return located_; }

  /// Locates returns [located(), until).
  void locate(const Coordinates& returns, std::uint32_t until, float min_z_m) noexcept;

  /// Copies the located returns into their bins.
  void group(const Coordinates& returns) noexcept;

  /// Bin of every located return; grid().num_bins() = none.
  const std::uint16_t* bin_of() const noexcept { return bin_of_.data(); }

  BinPoints points(int bin) const noexcept;

 private:
  PolarGrid grid_;
  std::uint32_t located_ = 0;
  AlignedArray<std::uint16_t> bin_of_;
  AlignedArray<std::uint32_t> next_;   // per bin, while grouping: where its next return goes
  AlignedArray<std::uint32_t> begin_;  // per bin and one beyond the last
  AlignedArray<float> x_m_, y_m_, z_m_;
};

}  // namespace pago::ground
