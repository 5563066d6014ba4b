// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/trust.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/se3.hpp"
#include "pago/core/units.hpp"

namespace pago::mapping {

HealthReason Trust::judge(const JointResult& result,
                          const Eigen::Isometry3d& T_last_predicted,
                          const Vector6d& last_twist,
                          double period_s) const noexcept {
  const TrustConfig& c = config_.trust;
  if (!result.T_last_this.matrix().allFinite() || !result.information.allFinite())
    return HealthReason::kNotFinite;
  if (static_cast<int>(result.matches) < c.min_matches) return HealthReason::kTooFewFeatures;
  if (!is_usual(result.score)) return HealthReason::kPoorFit;

  const Vector6d correction = difference(T_last_predicted, result.T_last_this);
  const double leeway = 1.0 + failures_;
  if (correction.head<3>().norm() > leeway * c.max_correction_m ||
      correction.tail<3>().norm() > leeway * c.max_correction_deg * kDegree)
    return HealthReason::kImplausibleMotion;
  const Vector6d twist = log_se3(result.T_last_this) / period_s;
  const double acceleration_m_s2 = (twist - last_twist).head<3>().norm() / period_s;
  // A place that has gone astray under an unknown acceleration does so with the square of the time.
  if (acceleration_m_s2 > leeway * leeway * c.max_acceleration_m_s2) return HealthReason::kImplausibleMotion;
  return result.doubted.count > 0 || doubts_ > 0 ? HealthReason::kNotObservable : HealthReason::kNone;
}

void Trust::accept(const JointResult& result) noexcept {
  scores_[num_scores_++ % kMemory] = static_cast<float>(result.score);
  failures_ = 0;
  constexpr int kSweeps = 5;
  doubts_ = result.doubted.count > 0 ? kSweeps : std::max(0, doubts_ - 1);
}

double Trust::usual_score() const noexcept {
  const std::size_t n = std::min(num_scores_, kMemory);
  if (n == 0) return 0.0;
  std::array<float, kMemory> sorted = scores_;
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(sorted.begin(), median, sorted.begin() + static_cast<std::ptrdiff_t>(n));
  return static_cast<double>(*median);
}

JointLimits Trust::limits() const noexcept {
  constexpr double kWidening = 1.5, kWidest_m = 2.0;
  const double factor = std::pow(kWidening, std::min(failures_, 10));
  return {std::min(kWidest_m, factor * config_.gate_m), std::min(kWidest_m, factor * config_.kernel_min_m),
          config_.max_iterations};
}

}  // namespace pago::mapping
