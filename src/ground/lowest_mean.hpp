// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "pago/core/aligned_array.hpp"

namespace pago::ground {

/// Mean of the lowest values of a list without sorting it: one pass bounds the k-th lowest, one collects what
/// is not above the bound. Same value as sorting, whatever the order of the list.
class LowestMean {
 public:
  /// [set-up] For lists of up to `max_values`; allocates.
  explicit LowestMean(std::size_t max_values);

  /// [front thread] Of the `count` (at least 1) lowest of those values that are not below `floor`; of all of
  /// these when they are fewer; nothing when there is none. No value may be NaN.
  std::optional<double> operator()(std::span<const float> values, std::size_t count, float floor) noexcept;

 private:
  std::size_t collect(std::span<const float> values, float floor, float ceiling) noexcept;
  AlignedArray<float> candidates_;
};

}  // namespace pago::ground
