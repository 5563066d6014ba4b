// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/stage.hpp"
#include "pago/mapping/keyframes.hpp"
#include "pago/mapping/laser_offsets.hpp"
#include "pago/mapping/standstill.hpp"
#include "pago/mapping/start_search.hpp"
#include "pago/mapping/trust.hpp"

namespace pago::mapping {

/// Scan-to-map as a pipeline stage, on every sweep: completes sweep.estimate by the refined pose, its
/// covariance and health. Starts by finding out how the vehicle moves; carries the pose on by odometry's
/// motion where a sweep does not fit the map, looks for it in the neighbourhood, and begins a new map in the
/// end.
///
/// finish() registers; update(), called once the refined pose is out, puts the sweep into the map.
/// [set-up] constructor: about 45 MB at the defaults; [estimate thread] the rest: real-time safe,
/// deterministic.
class MappingStage {
 public:
  explicit MappingStage(const MappingConfig& config);

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept;
  void update(Sweep& sweep) noexcept;

  /// As if no sweep had come yet: the next one defines `odom` anew, over an empty map.
  void reset() noexcept;

  /// Lets refinements end early from now on; `budget` must outlive the stage or the next call.
  void set_budget(const Budget& budget) noexcept { budget_ = &budget; }

  /// What odometry starts its next sweep from.
  const RefinedState& refined() const noexcept { return refined_; }

 private:
  enum class Phase { kEmpty, kSearching, kTracking };

  void load(const Sweep& sweep) noexcept;
  void start(Sweep& sweep) noexcept;
  void search(const ScanMotion& motion, Estimate& estimate) noexcept;
  void track(const ScanMotion& motion, Sweep& sweep) noexcept;
  MotionGuess guess_of(const ScanMotion& motion) const noexcept;
  JointResult look_closer(const MotionGuess& guess, const JointResult& result) noexcept;
  JointResult relocalise(const MotionGuess& guess) noexcept;
  void adopt(const ScanMotion& motion,
             const MotionGuess& guess,
             const JointResult& result,
             bool usable) noexcept;
  void move_to(const Eigen::Isometry3d& T_map_this,
               double period_s,
               const std::optional<MotionInSweep>& within = std::nullopt) noexcept;
  void forget_changes() noexcept;
  Vector6d unsteadiness() const noexcept;
  void restart(bool is_told, Estimate& estimate) noexcept;
  void state(const ScanMotion& motion,
             const MotionGuess& guess,
             const JointResult& result,
             HealthReason reason,
             Estimate& estimate) const noexcept;
  void report(const ScanMotion& motion, Estimate& estimate) noexcept;

  MappingConfig config_;
  const Budget* budget_ = &kUnlimited;
  registration::CellMap map_;
  JointRegistration registration_;
  StartSearch start_;
  Trust trust_;
  Standstill standstill_;
  Keyframes keyframes_;
  LaserOffsets lasers_;
  registration::PointCloud key_points_, map_points_, dense_;
  AlignedArray<std::uint8_t> rings_;  // of key_points_

  Phase phase_ = Phase::kEmpty;
  std::int64_t first_reference_ns_ = 0, first_reported_ns_ = 0;
  RefinedState refined_;
  Vector6d acceleration_ = Vector6d::Zero();  // of refined_.twist, of the last few sweeps
  Vector6d mean_sq_acceleration_ = Vector6d::Zero();
  MotionInSweep within_;  // about the reference instant
  /// Poses in the map are relative to the first sweep's reference instant; `odom` to its reported one.
  Eigen::Isometry3d T_odom_map_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_start_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_reference_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_measured_ = Eigen::Isometry3d::Identity();  // the last that was no guess,
  double unmeasured_s_ = 0.0;                                         // and since when there was none
  double since_searched_s_ = 0.0;  // since the last sweep that took part in the search
  bool is_placed_ = false;
  int predicted_in_a_row_ = 0;  // neither the map nor the last sweep told the motion
  int unconfirmed_ = 0;         // sweeps in a row with a direction that nothing measured
  bool is_elsewhere_ = false;   // since a long gap nothing fits the map
  bool is_inserted_ = false;    // the present sweep belongs into the map
  int inserted_standing_ = 0;
};

}  // namespace pago::mapping
