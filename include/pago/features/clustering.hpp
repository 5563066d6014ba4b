// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pago/config/features.hpp"
#include "pago/core/sweep.hpp"
#include "pago/features/feature_image.hpp"

namespace pago::features {

/// Groups the non-ground returns of a range image into segments: neighbours belong together
/// when the angle between the line through them and the farther beam exceeds a threshold (Bogoslavskyi and
/// Stachniss 2016; LeGO-LOAM section III.C). The angle comes from the two returns themselves, so that uneven
/// ring spacing needs no table; in a grid of equal angles it is the grid's. Connectivity is solved by
/// union-find, which finds the same segments as a flood fill, in one pass.
///
/// [set-up] constructor; [front thread] label(): real-time safe, deterministic.
class Clusterer {
 public:
  Clusterer(const ClusteringConfig& config, std::uint32_t max_returns);

  /// Writes sweep.cluster for every return: 0 on ground, 1, 2, ... for segments in order of their first
  /// return, kClutter for returns in segments too small to trust and for those without a cell.
  void label(Sweep& sweep, const FeatureImage& image) noexcept;
  /// In the sweep's own range image.
  void label(Sweep& sweep) noexcept { label(sweep, own_image(sweep)); }

 private:
  struct Segment {
    std::uint32_t num_points = 0;
    std::uint64_t rings = 0;  // bit per ring
  };

  void join_neighbours(const Sweep& sweep, const FeatureImage& image) noexcept;
  void join_diagonals(const Sweep& sweep, const FeatureImage& image) noexcept;
  void join_if_smooth(const Sweep& sweep, std::uint32_t a, std::uint32_t b, float step_rad) noexcept;
  bool is_smooth(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float step_rad) const noexcept;
  void measure(const FeatureImage& image, std::uint32_t size) noexcept;
  bool is_valid(const Segment& segment) const noexcept;
  std::uint32_t root(std::uint32_t i) noexcept;

  ClusteringConfig config_;
  double tan_join_;
  float tan_join_sq_;
  AlignedArray<std::uint32_t> parent_;
  AlignedArray<Segment> segments_;        // indexed by root
  AlignedArray<std::uint16_t> label_of_;  // indexed by root
};

}  // namespace pago::features
