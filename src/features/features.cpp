// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/features.hpp"

#include <algorithm>
#include <cmath>

#include "ring_sequence.hpp"

namespace pago::features {

FeaturesStage::FeaturesStage(const FeaturesConfig& config, std::uint32_t max_returns)
    : config_(config),
      clusterer_(config.clustering, max_returns),
      thinner_(config.thinning, max_returns),
      ring_(kMaxColumns),
      candidates_(kMaxColumns),
      is_edge_(kMaxColumns) {
  if (config.projection == Projection::kUniform)
    grid_ = std::make_unique<UniformGrid>(config.grid, config.min_range_m, max_returns);
}

void FeaturesStage::finish(Sweep& sweep) noexcept {
  thinner_.finish(sweep);
  const FeatureImage image = grid_ ? grid_->project(sweep) : own_image(sweep);
  clusterer_.label(sweep, image);
  FeatureLists& lists = sweep.features;
  for (int ring = 0; ring < kNumRings; ++ring) {
    load_ring(sweep, image, ring);
    compute_smoothness(ring_, config_.smoothness);
    block_unreliable(ring_, config_);
    select(sweep);
    if (config_.planars_per_sector == 0) keep_targets(sweep, image.columns);
    const auto next = static_cast<std::size_t>(ring) + 1;
    lists.edge_rows[next] = static_cast<std::uint32_t>(lists.edges.size());
    lists.planar_rows[next] = static_cast<std::uint32_t>(lists.planars.size());
  }
}

/// LeGO-LOAM's code keeps all columns beside the cut, for no stated reason.
bool FeaturesStage::is_left_out(int column, int columns) const noexcept {
  constexpr int kAlways = 5;
  return column % config_.ground_every_columns != 0 && column > kAlways && column < columns - kAlways;
}

void FeaturesStage::load_ring(Sweep& sweep, const FeatureImage& image, int ring) noexcept {
  const std::int32_t* row = image.cells.row(ring);
  const auto min_range_m = static_cast<float>(config_.min_range_m);
  ring_.size = 0;
  for (int column = 0; column < image.columns; ++column) {
    if (row[column] == RangeImage::kEmpty) continue;
    const auto i = static_cast<std::uint32_t>(row[column]);
    if (sweep.cluster[i] == kClutter) {
      const int every = config_.outlier_every_columns;
      if (every > 0 && column % every == 0 && ring > config_.outliers_above_row)
        sweep.features.outliers.push_back(i);
      continue;
    }
    if (image.ground[i] == kGround && is_left_out(column, image.columns)) continue;
    const float range_m =
        std::sqrt(sweep.x_m[i] * sweep.x_m[i] + sweep.y_m[i] * sweep.y_m[i] + sweep.z_m[i] * sweep.z_m[i]);
    if (!(range_m >= min_range_m)) continue;
    const std::size_t n = ring_.size++;
    ring_.index[n] = i;
    ring_.column[n] = column;
    ring_.range_m[n] = range_m;
    ring_.is_ground[n] = image.ground[i];
  }
  std::fill_n(is_edge_.data(), ring_.size, std::uint8_t{0});
}

void FeaturesStage::select(Sweep& sweep) noexcept {
  if (ring_.size < 2 * kReach + 1) return;
  const std::size_t first = kReach, length = ring_.size - 2 * kReach;
  const auto sectors = static_cast<std::size_t>(config_.sectors);
  for (std::size_t s = 0; s < sectors; ++s) {
    const std::size_t begin = first + length * s / sectors;
    const std::size_t end = first + length * (s + 1) / sectors;
    select_edges(sweep.features, begin, end);
    select_planars(sweep.features, begin, end, kGround);
    if (config_.planar_source == PlanarSource::kBoth) select_planars(sweep.features, begin, end, kNonGround);
    if (config_.planars_per_sector > 0) select_targets(sweep.features, begin, end);
  }
}

// Roughest first; each pick blocks its neighbours. The first few are registered, all of them are registered
// against.
void FeaturesStage::select_edges(FeatureLists& lists, std::size_t begin, std::size_t end) noexcept {
  candidates_.clear();
  const auto threshold = static_cast<float>(config_.edge_threshold);
  for (std::size_t i = begin; i < end; ++i) {
    if (!ring_.blocked[i] && ring_.is_ground[i] == kNonGround && ring_.smoothness[i] > threshold) {
      candidates_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return ring_.smoothness[a] != ring_.smoothness[b] ? ring_.smoothness[a] > ring_.smoothness[b] : a < b;
  });
  int picked = 0;
  for (const std::uint32_t i : candidates_) {
    if (picked == config_.edges_per_sector) break;
    if (ring_.blocked[i]) continue;
    if (picked++ < config_.sharp_edges_per_sector) lists.sharp_edges.push_back(ring_.index[i]);
    lists.edges.push_back(ring_.index[i]);
    is_edge_[i] = 1;
    block_around(ring_, i);
  }
}

void FeaturesStage::select_planars(FeatureLists& lists,
                                   std::size_t begin,
                                   std::size_t end,
                                   std::uint8_t ground) noexcept {
  for (int picked = 0; picked < config_.flat_planars_per_sector; ++picked) {
    auto best_smoothness = static_cast<float>(config_.planar_threshold);
    std::size_t best = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!ring_.blocked[i] && ring_.is_ground[i] == ground && ring_.smoothness[i] < best_smoothness) {
        best_smoothness = ring_.smoothness[i];
        best = i;
      }
    }
    if (best == end) return;
    lists.flat_planars.push_back(ring_.index[best]);
    block_around(ring_, best);
  }
}

// The flattest that are no edge, neighbours or not.
void FeaturesStage::select_targets(FeatureLists& lists, std::size_t begin, std::size_t end) noexcept {
  candidates_.clear();
  const auto threshold = static_cast<float>(config_.planar_threshold);
  for (std::size_t i = begin; i < end; ++i)
    if (is_edge_[i] == 0 && ring_.smoothness[i] < threshold)
      candidates_.push_back(static_cast<std::uint32_t>(i));
  std::sort(candidates_.begin(), candidates_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return ring_.smoothness[a] != ring_.smoothness[b] ? ring_.smoothness[a] < ring_.smoothness[b] : a < b;
  });
  const auto wanted = std::min(candidates_.size(), static_cast<std::size_t>(config_.planars_per_sector));
  for (std::size_t n = 0; n < wanted; ++n) lists.planars.push_back(ring_.index[candidates_[n]]);
}

// All that is no edge, thinned: what later sweeps find planes in.
void FeaturesStage::keep_targets(Sweep& sweep, int columns) noexcept {
  const bool keeps_all = config_.planar_spacing_m <= 0.0;
  const SpacingSampler sampler(keeps_all ? 1.0 : config_.planar_spacing_m,
                               static_cast<std::uint32_t>(columns),
                               static_cast<std::uint32_t>(sweep.header.sequence));
  for (std::size_t n = 0; n < ring_.size; ++n) {
    if (is_edge_[n] == 0 && (keeps_all || sampler.keeps(ring_.index[n], ring_.range_m[n] * ring_.range_m[n])))
      sweep.features.planars.push_back(ring_.index[n]);
  }
}

}  // namespace pago::features
