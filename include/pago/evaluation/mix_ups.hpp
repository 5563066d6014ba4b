// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/evaluation/association.hpp"
#include "pago/evaluation/trajectory.hpp"

namespace pago::evaluation {

enum class MixUpKind {
  kUnsorted,         ///< rows in the order of their file names as words: 0, 1, 10, 100, 2, ...
  kReversed,         ///< last pose first
  kInverted,         ///< T_sensor_world where T_world_sensor belongs
  kQuaternionOrder,  ///< qw first
  kMirrored,         ///< left-handed: turns go the other way
  kScale,            ///< another unit of length
  kCameraFrame,      ///< poses of KITTI's camera taken for the sensor's, or the other way round
  kBodyTurned,       ///< the two files hold poses of bodies that are turned against each other
  kBodyMoved,        ///< ... or mounted apart
  kTimeShift,        ///< another instant of the sweep, rows off by one, clocks apart
};

/// A mistake in what was given, which would explain most of the error.
struct MixUp {
  MixUpKind kind = MixUpKind::kTimeShift;
  std::string finding;   ///< what seems to be the case
  std::string evidence;  ///< the figures that say so
  std::string remedy;    ///< what to do about it
  double amount = 0.0;   ///< rows of a time shift, ratio of a scale, degrees of a turn, metres of a lever

  std::string sentence() const { return finding + ": " + evidence + ". " + remedy; }
};

/// Compares the motions between rows, which depend on neither world: a file that says something else than it
/// is taken for moves in a way that no estimate errs. Both trajectories as evaluate() scores them, frames
/// converted. Empty where nothing is suspicious or the path is too short to tell (under 20 rows or 5 m).
std::vector<MixUp> find_mix_ups(const Trajectory& truth,
                                const Trajectory& estimate,
                                const MatchOptions& options);

}  // namespace pago::evaluation
