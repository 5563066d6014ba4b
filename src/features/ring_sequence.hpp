// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/features/features.hpp"

namespace pago::features {

/// Neighbours on either side that make up a return's smoothness (LOAM: |S| = 10).
inline constexpr std::size_t kReach = 5;
/// A step of this many columns or more between two entries separates them (LeGO-LOAM: 10).
inline constexpr std::int32_t kColumnGap = 10;

/// Rates every entry that has kReach neighbours on both sides; LeGO-LOAM's and LOAM's formulas (odometry
/// notes 1.5).
void compute_smoothness(RingSequence& ring, Smoothness measure) noexcept;

/// Blocks entries on the far side of a range jump (what is seen of it depends on the viewpoint) and entries
/// where the beam grazes a surface (LOAM section V.A).
void block_unreliable(RingSequence& ring, const FeaturesConfig& config) noexcept;

/// Blocks the neighbours of a picked entry, up to kReach on each side as long as no gap intervenes.
void block_around(RingSequence& ring, std::size_t picked) noexcept;

}  // namespace pago::features
