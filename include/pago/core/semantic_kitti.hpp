// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Classes of SemanticKITTI's labels (Behley et al., ICCV 2019; numbers: semantic-kitti.yaml of its API), as
/// far as PaGO tells them apart. A label's low 16 bits are the class.
namespace pago::semantic_kitti {

inline constexpr std::uint16_t kUnlabelled = 0, kOutlier = 1;
inline constexpr std::uint16_t kRoad = 40, kParking = 44, kSidewalk = 48, kOtherGround = 49,
                               kLaneMarking = 60, kTerrain = 72;
inline constexpr std::uint16_t kVegetation = 70;

/// What a vehicle could stand on. Vegetation is what protocols differ about (evaluation/ground_metrics.hpp).
constexpr bool is_ground(std::uint16_t label) noexcept {
  switch (label) {
    case kRoad:
    case kParking:
    case kSidewalk:
    case kOtherGround:
    case kLaneMarking:
    case kTerrain:
      return true;
    default:
      return false;
  }
}

}  // namespace pago::semantic_kitti
