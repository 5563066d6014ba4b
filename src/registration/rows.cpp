// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "pago/core/symmetric6.hpp"

namespace pago::registration {

namespace {

Vector6d to_metres() noexcept {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1.0 / kLeverArm_m);
  return scale;
}

double contribution_of(std::span<const Row> rows, const Vector6d& direction) noexcept {
  constexpr float kClear = 0.25F;
  const Eigen::Matrix<float, 6, 1> scaled = to_metres().cwiseProduct(direction).cast<float>();
  std::array<float, 256> of_block{};
  for (const Row& row : rows) {
    const float cosine = row.J.dot(scaled);
    if (std::abs(cosine) >= kClear) of_block[row.block] += row.kernel_weight * cosine * cosine;
  }
  return std::accumulate(of_block.begin(), of_block.end(), 0.0,
                         [](double sum, float block) { return sum + std::min(1.0, double{block}); });
}

}  // namespace

void NormalEquations::add(std::span<const Row> rows) noexcept {
  for (const Row& row : rows) {
    const Vector6d J = row.J.cast<double>();
    const auto w = static_cast<double>(row.kernel_weight / row.variance_m2);
    const auto r = static_cast<double>(row.residual_m);
    H.noalias() += (w * J) * J.transpose();
    b.noalias() += (w * r) * J;
    weight += w, weighted_sq_m2 += w * r * r;
  }
}

double NormalEquations::rms_m() const noexcept {
  return weight > 0.0 ? std::sqrt(weighted_sq_m2 / weight) : 0.0;
}

WeakDirections find_weak_directions(const Matrix6d& information,
                                    std::span<const Row> rows,
                                    double min_contribution) noexcept {
  constexpr double kForbidden = 1e12;  // information per square metre: far above what any sweep gives
  const Vector6d scale = to_metres();
  WeakDirections weak;
  if (!information.allFinite()) return {6, kForbidden * Matrix6d::Identity(), Matrix6d::Zero(), 0x3f};
  const Eigen6 principal = eigen_of(scale.asDiagonal() * information * scale.asDiagonal());
  Vector6d share = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector6d direction = principal.vectors.col(i);
    if (contribution_of(rows, direction) >= min_contribution) continue;
    ++weak.count;
    const Vector6d unscaled = direction.cwiseQuotient(scale);
    weak.penalty += kForbidden * unscaled * unscaled.transpose();
    weak.strong -= direction.cwiseProduct(scale) * unscaled.transpose();
    share += direction.cwiseAbs2();
  }
  for (int i = 0; i < 6; ++i) weak.axes |= static_cast<std::uint8_t>((share[i] > 0.5 ? 1U : 0U) << i);
  return weak;
}

}  // namespace pago::registration
