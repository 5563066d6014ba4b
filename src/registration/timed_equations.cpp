// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/timed_equations.hpp"

#include <algorithm>

namespace pago::registration {

void TimedEquations::clear() noexcept {
  bins_.fill({});
}

void TimedEquations::add(const Row& row, float before_s) noexcept {
  constexpr float kPerSecond = 256.0F;
  const int bin = static_cast<int>(kPerSecond * -before_s + 0.5F * kBins);
  Bin& at = bins_[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))];
  at.equations.add({&row, 1});
  at.weighted_after_s -= static_cast<double>(before_s * row.kernel_weight / row.variance_m2);
}

NormalEquations TimedEquations::sum() const noexcept {
  NormalEquations sum;
  for (const Bin& bin : bins_) {
    sum.H += bin.equations.H, sum.b += bin.equations.b;
    sum.weight += bin.equations.weight, sum.weighted_sq_m2 += bin.equations.weighted_sq_m2;
  }
  return sum;
}

BendEquations TimedEquations::bends() const noexcept {
  BendEquations sum;
  for (const Bin& bin : bins_) {
    const NormalEquations& e = bin.equations;
    if (e.weight <= 0.0) continue;
    const double s = bin.weighted_after_s / e.weight, half_s2 = 0.5 * s * s;
    sum.motion_bend.leftCols<6>() += s * e.H;
    sum.motion_bend.rightCols<6>() += half_s2 * e.H;
    sum.bend_bend.topLeftCorner<6, 6>() += s * s * e.H;
    sum.bend_bend.topRightCorner<6, 6>() += s * half_s2 * e.H;
    sum.bend_bend.bottomRightCorner<6, 6>() += half_s2 * half_s2 * e.H;
    sum.b.head<6>() += s * e.b;
    sum.b.tail<6>() += half_s2 * e.b;
  }
  sum.bend_bend.bottomLeftCorner<6, 6>() = sum.bend_bend.topRightCorner<6, 6>().transpose();
  return sum;
}

}  // namespace pago::registration
