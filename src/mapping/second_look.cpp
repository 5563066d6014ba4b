// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What mapping tries when the first registration of a sweep is not good enough.
#include <algorithm>
#include <array>

#include "pago/core/se3.hpp"
#include "pago/core/units.hpp"
#include "pago/mapping/mapping.hpp"

namespace pago::mapping {

// Where little is seen, more points of it are worth their time: most of all those that stand upright.
JointResult MappingStage::look_closer(const MotionGuess& guess, const JointResult& result) noexcept {
  constexpr int kMostIterations = 4;
  JointLimits limits = trust_.limits();
  limits.stride = 1 + map_points_.size / (kMaxKeyPoints + 1);
  limits.thins_ground_only = true;
  limits.T_first = result.T_last_this;
  limits.max_iterations = std::min(limits.max_iterations, kMostIterations);
  return registration_.align(map_, map_points_, guess, limits, *budget_);
}

// Where could it be, if the velocity has changed since the sweep before? Seeds along the way and to its
// sides, tried on a part of the points; the best is then registered with all of them.
JointResult MappingStage::relocalise(const MotionGuess& guess) noexcept {
  constexpr double kAcceleration_m_s2 = 3.0, kLeast_m = 3.0, kMost_m = 15.0, kStep_m = 1.5;
  constexpr std::array<double, 5> kTurns_deg{0.0, 10.0, -10.0, 20.0, -20.0};
  constexpr std::size_t kStride = 4;
  const double period_s = std::max(guess.period_s, 0.1) * (1 + trust_.failures());
  const double reach_m = std::clamp(0.5 * kAcceleration_m_s2 * period_s * period_s, kLeast_m, kMost_m);
  const int steps = static_cast<int>(reach_m / kStep_m);
  MotionGuess seed = guess;
  seed.information.setZero();
  seed.twist = refined_.twist;
  seed.acceleration.reset();
  JointResult best;
  for (const double turn_deg : kTurns_deg) {
    for (int step = -steps; step <= steps; ++step) {
      Vector6d offset = Vector6d::Zero();
      offset[0] = step * kStep_m, offset[5] = turn_deg * kDegree;
      seed.T_last_this = guess.T_last_this * exp_se3(offset);
      const JointResult tried = registration_.align(
          map_, key_points_, seed, {config_.gate_m, config_.start.kernel_m, config_.max_iterations, kStride});
      if (tried.score > best.score) best = tried;
    }
  }
  seed.T_last_this = best.T_last_this;
  return registration_.align(map_, key_points_, seed,
                             {config_.gate_m, config_.kernel_min_m, config_.max_iterations});
}

}  // namespace pago::mapping
