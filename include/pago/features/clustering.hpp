// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/config/features.hpp"
#include "pago/core/sweep.hpp"

namespace pago::features {

/// Groups the non-ground returns of a range image into segments: neighbours in ring or column belong together
/// when the angle between the line through them and the farther beam exceeds a threshold (Bogoslavskyi and
/// Stachniss 2016; LeGO-LOAM section III.C). The angle comes from the two returns themselves, so that uneven
/// ring spacing needs no table. Connectivity is solved by union-find, which finds the same segments as a
/// flood fill, in one pass.
///
/// [set-up] constructor; [front thread] label(): real-time safe, deterministic.
class Clusterer {
 public:
  Clusterer(const ClusteringConfig& config, std::uint32_t max_returns);

  /// Writes sweep.cluster for every return: 0 on ground, 1, 2, ... for segments in order of their first
  /// return, kClutter for returns in segments too small to trust and for those without a cell.
  void label(Sweep& sweep) noexcept;

 private:
  struct Segment {
    std::uint32_t num_points = 0;
    std::uint64_t rings = 0;  // bit per ring
  };

  void join_neighbours(const Sweep& sweep) noexcept;
  void join_if_smooth(const Sweep& sweep, std::uint32_t a, std::uint32_t b) noexcept;
  void measure(const Sweep& sweep) noexcept;
  bool is_valid(const Segment& segment) const noexcept;
  std::uint32_t root(std::uint32_t i) noexcept;

  ClusteringConfig config_;
  float tan_join_sq_;
  AlignedArray<std::uint32_t> parent_;
  AlignedArray<Segment> segments_;        // indexed by root
  AlignedArray<std::uint16_t> label_of_;  // indexed by root
};

}  // namespace pago::features
