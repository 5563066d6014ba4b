// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "pago/config/ground/mount_check.hpp"
#include "plane_grower.hpp"
#include "polar_bins.hpp"

namespace pago::ground {

/// A value with a weight, and how far from it the truth may be.
struct BoundedValue {
  double value = 0.0, reach = 0.0, weight = 0.0;
};

/// What some values agree on, and how many do.
struct Agreement {
  double value = 0.0;
  std::size_t count = 0;
};

/// The weighted mean of those values that agree, by the truncated consensus of TEASER++ (Yang, Shi and
/// Carlone, T-RO 2021, Sec. VI-C): of all sets of values whose intervals overlap, the one whose squared
/// residuals and the others' reaches add up to least. None of nothing. Up to kMaxValues; real-time safe.
inline constexpr std::size_t kMaxValues = 360;
Agreement consensus(std::span<const BoundedValue> values) noexcept;

/// The sensor's height by ATAT: a ground plane in each of some sectors near the sensor, and what most of them
/// agree on. [front thread] everything but the constructor; real-time safe.
///
/// Differs from the authors' code: lowest returns are the lowest (there the cloud is not sorted); what lies
/// at the last sector's very end is in it; no ground is an answer, not an exception; the estimate is not kept
/// in a variable that all instances share.
class HeightEstimate {
 public:
  /// [set-up] Allocates.
  HeightEstimate(const HeightEstimateConfig& config, const Mount& mount, std::uint32_t max_returns);

  /// Of the sensor above the ground around it; nothing if no sector shows ground.
  std::optional<double> operator()(const Sweep& sweep) noexcept;

 private:
  static constexpr std::size_t kRadii = 3;  // max_range_m, twice, four times

  std::optional<double> estimate(const Coordinates& returns, const Sweep& sweep, PolarBins& bins) noexcept;

  HeightEstimateConfig config_;
  Leveller level_;
  std::vector<PolarBins> bins_;  // kRadii
  PlaneGrower grow_;
};

}  // namespace pago::ground
