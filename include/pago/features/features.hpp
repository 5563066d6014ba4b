// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/config/features.hpp"
#include "pago/core/stage.hpp"
#include "pago/features/clustering.hpp"
#include "pago/features/feature_image.hpp"
#include "pago/features/thinning.hpp"

namespace pago::features {

/// One ring as a sequence: its usable returns in column order. Structure of arrays, one entry per return.
struct RingSequence {
  explicit RingSequence(std::size_t max_columns)
      : index(max_columns),
        column(max_columns),
        range_m(max_columns),
        smoothness(max_columns),
        is_ground(max_columns),
        blocked(max_columns) {}

  std::size_t size = 0;
  AlignedArray<std::uint32_t> index;  ///< of the return in the sweep
  AlignedArray<std::int32_t> column;
  AlignedArray<float> range_m;
  AlignedArray<float> smoothness;  ///< infinity where it is not defined
  AlignedArray<std::uint8_t> is_ground;
  AlignedArray<std::uint8_t> blocked;  ///< occluded, grazed, or beside one that was picked
};

/// Feature extraction as a pipeline stage (LeGO-LOAM section III.C-D, PaGO-LOAM): clusters, then along each
/// ring edges (rough, never ground) and planar points (smooth; ground and other surfaces). Fills
/// sweep.cluster and sweep.features. What LeGO-LOAM's code and text do otherwise is a setting each. [set-up]
/// constructor; [front thread] the rest: real-time safe, deterministic.
class FeaturesStage {
 public:
  FeaturesStage(const FeaturesConfig& config, std::uint32_t max_returns);

  void begin(Sweep& sweep) noexcept { thinner_.begin(sweep); }
  void accept(const SweepPart& part) noexcept { thinner_.accept(*part.sweep, part.returns_until); }
  void finish(Sweep& sweep) noexcept;

 private:
  void load_ring(Sweep& sweep, const FeatureImage& image, int ring) noexcept;
  bool is_left_out(int column, int columns) const noexcept;
  void select(Sweep& sweep) noexcept;
  void select_edges(FeatureLists& lists, std::size_t begin, std::size_t end) noexcept;
  void select_planars(FeatureLists& lists, std::size_t begin, std::size_t end, std::uint8_t ground) noexcept;
  void select_targets(FeatureLists& lists, std::size_t begin, std::size_t end) noexcept;
  void keep_targets(Sweep& sweep, int columns) noexcept;

  FeaturesConfig config_;
  std::unique_ptr<UniformGrid> grid_;  // with projection = uniform
  Clusterer clusterer_;
  SweepThinner thinner_;
  RingSequence ring_;
  FixedVector<std::uint32_t> candidates_;
  AlignedArray<std::uint8_t> is_edge_;
};

}  // namespace pago::features
