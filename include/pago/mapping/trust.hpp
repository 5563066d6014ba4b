// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "pago/mapping/joint_registration.hpp"

namespace pago::mapping {

/// Whether a registration can be believed: against the motion model, and against how well the sweeps before
/// it fitted the map. (A fixed share of inliers will not do: it is 0.4 in a wood and 0.8 in a street.) Keeps
/// count of failures; gates and kernel widen with them, so that what was lost can be found again. [estimate
/// thread] real-time safe, deterministic.
class Trust {
 public:
  explicit Trust(const MappingConfig& config) : config_(config) {}

  /// Why not to believe it; kNone or kNotObservable: it can be used. What was not observable must be so for a
  /// few sweeps before it is believed again: doors of a tunnel come one at a time. `T_last_predicted` is
  /// where the motion model expects the sweep; `last_twist` the velocity before.
  HealthReason judge(const JointResult& result,
                     const Eigen::Isometry3d& T_last_predicted,
                     const Vector6d& last_twist,
                     double period_s) const noexcept;

  void accept(const JointResult& result) noexcept;
  void reject() noexcept { ++failures_; }
  /// What was usual is forgotten, too.
  void restart() noexcept { failures_ = 0, num_scores_ = 0, doubts_ = 0; }

  int failures() const noexcept { return failures_; }  ///< in a row
  JointLimits limits() const noexcept;
  /// Score that a sweep usually has here; 0 while nothing is usual.
  double usual_score() const noexcept;
  /// Whether a score is as good as sweeps have been of late.
  bool is_usual(double score) const noexcept {
    return score >= config_.trust.min_score_ratio * usual_score();
  }

 private:
  static constexpr std::size_t kMemory = 21;

  MappingConfig config_;
  std::array<float, kMemory> scores_{};
  std::size_t num_scores_ = 0;
  int failures_ = 0;
  int doubts_ = 0;  // sweeps without a doubted direction that are still to come
};

}  // namespace pago::mapping
