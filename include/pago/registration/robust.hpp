// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>

namespace pago::registration {

/// Weight of a residual under the Geman-McClure kernel of width k: (k^2 / (k^2 + r^2))^2.
template <typename Real>
Real geman_mcclure(Real residual, Real width) noexcept {
  const Real ratio = width * width / (width * width + residual * residual);
  return ratio * ratio;
}

/// Three times the robust deviation of residuals about zero, at least `least`. Reorders `magnitudes`.
template <typename Real>
Real kernel_width(std::span<Real> magnitudes, Real least) noexcept {
  constexpr double kMadToSigma = 1.4826;  // of the normal distribution
  if (magnitudes.empty()) return least;
  const auto median = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), median, magnitudes.end());
  return std::max(least, static_cast<Real>(3.0 * kMadToSigma) * *median);
}

}  // namespace pago::registration
