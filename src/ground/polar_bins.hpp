// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bin_sort.hpp"
#include "level.hpp"
#include "swept_arc.hpp"

namespace pago::ground {

/// An annulus about the sensor, cut into equally wide rings and sectors. It ends where the next zone begins.
struct PolarZone {
  double lower_m = 0.0;
  int rings = 1, sectors = 1;
};

/// Where a bin lies. Azimuths are in turns, from the x axis to the left.
struct PolarCell {
  int zone = 0;
  int ring = 0;  ///< counted from the innermost of all zones
  float right_turns = 0.0F, left_turns = 0.0F;
  float centre_x_m = 0.0F, centre_y_m = 0.0F;
};

/// Up to four zones (Patchwork's concentric zone model; a uniform polar grid is one zone). Bins are numbered
/// zone by zone, in it ring by ring outwards, in it sector by sector from the x axis to the left.
class PolarGrid {
 public:
  static constexpr std::size_t kMaxZones = 4;

  /// [set-up] Covers lower_m of the first zone < range <= upper_m. Throws Error unless the bounds rise and
  /// there are at most BinSort::kMaxBins.
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

/// The returns of a sweep in the bins of a grid, sorted when the sweep has ended or, bin by bin, while it
/// arrives. [front thread] everything but the constructor; real-time safe.
class PolarBins {
 public:
  /// [set-up] Allocates.
  PolarBins(PolarGrid grid, std::uint32_t max_returns);

  const PolarGrid& grid() const noexcept { return grid_; }

  void begin() noexcept { sorted_.begin(); }
  std::uint32_t located() const noexcept { return sorted_.noted(); }

  /// Locates returns [located(), until).
  void locate(const Coordinates& returns, std::uint32_t until, float min_z_m) noexcept;

  /// Sorts the bins that lie wholly within the arc, as far as they are not yet.
  void sort_swept(const Coordinates& returns, const SweptArc& arc) noexcept;
  /// Sorts all others; or all bins again, should a return have come for a sorted one.
  void sort_rest(const Coordinates& returns) noexcept { sorted_.sort_rest(returns); }

  /// Whether the last call of the two above has sorted this bin.
  bool is_fresh(int bin) const noexcept { return sorted_.is_fresh(bin); }

  /// Bin of every located return; grid().num_bins() = none.
  const std::uint16_t* bin_of() const noexcept { return sorted_.bin_of(); }
  Points points(int bin) const noexcept { return sorted_.points(bin); }

 private:
  PolarGrid grid_;
  BinSort sorted_;
  FixedVector<std::uint16_t> swept_;
};

}  // namespace pago::ground
