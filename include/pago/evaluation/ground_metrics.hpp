// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "pago/core/mount.hpp"
#include "pago/core/sweep.hpp"

namespace pago::evaluation {

/// What counts as ground in SemanticKITTI labels. The same mask differs by some three points of F1 between
/// the two, so their figures never go into one table column or one mean.
enum class GroundProtocol {
  /// A, of the papers Patchwork and PaGO: road, parking, sidewalk, other ground, lane marking and terrain are
  /// ground, and so is vegetation below -3/4 of the height of KITTI's sensor; other vegetation is not.
  kPatchwork,
  /// B, of Patchwork++: as A, but vegetation is left out of everything.
  kPatchworkPlusPlus,
};
/// "A (Patchwork)", "B (Patchwork++)".
std::string_view to_string(GroundProtocol protocol) noexcept;

/// Points of one frame, or of several, by truth and mask. Unlabelled and outlier points are in `excluded`.
struct GroundCounts {
  GroundProtocol protocol = GroundProtocol::kPatchwork;
  std::uint64_t true_positive = 0, false_positive = 0, false_negative = 0, true_negative = 0, excluded = 0;
};

/// 3/4 of the height of KITTI's sensor, as the Patchwork authors' evaluation has it.
inline constexpr float kVegetationCutMetres = -0.75F * 1.73F;

/// Counts one frame. `labels` are SemanticKITTI's (the low 16 bits are the class), `z_m` the points' heights
/// in the sensor frame, `mask` not 0 where the method says ground. Error unless all three cover every point.
GroundCounts count_ground(GroundProtocol protocol,
                          std::span<const std::uint32_t> labels,
                          std::span<const float> z_m,
                          std::span<const std::uint8_t> mask,
                          float vegetation_cut_m = kVegetationCutMetres);

/// The same of a sweep that has its labels (kLabelled) and its mask. Its heights are levelled by the mount's
/// roll and pitch; the cut is KITTI's, whatever height the mount has: what is true does not depend on what
/// the methods believe.
GroundCounts count_ground(GroundProtocol protocol, const Sweep& sweep, const Mount& mount = {});

/// All in [0, 1]. A ratio of nothing to nothing is not defined: NaN, which reports print as n/a.
struct GroundScore {
  double precision = 0.0, recall = 0.0, f1 = 0.0, accuracy = 0.0, iou = 0.0;
};
GroundScore ground_score(const GroundCounts& counts);

/// Over the frames of a sequence that have ground to be found. The published means are `mean`; `deviation`
/// is the stability figure of the PaGO paper. A frame where a score is not defined has no part in its mean;
/// where it is defined in none, the mean is not either.
struct GroundSummary {
  GroundProtocol protocol = GroundProtocol::kPatchwork;
  std::size_t num_frames = 0;  ///< with ground
  GroundScore mean;            ///< of the frames' scores
  GroundScore deviation;       ///< standard deviation over the frames (divided by n)
  GroundScore pooled;          ///< of all points of all frames together
};

/// Error when there is no frame, or when the frames were counted by different protocols.
GroundSummary summarize_ground(std::span<const GroundCounts> frames);

/// Reads a .label file: one little-endian uint32 per point. Error when it cannot be read or does not hold
/// exactly `num_points` labels.
std::vector<std::uint32_t> read_semantic_labels(const std::filesystem::path& file, std::size_t num_points);

}  // namespace pago::evaluation
