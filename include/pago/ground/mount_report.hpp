// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "pago/core/mount.hpp"

namespace pago::ground {

/// Whether the first sweeps agree with the mount.
enum class MountFinding : std::uint8_t {
  kPending,      ///< not enough sweeps yet, or the check is switched off
  kAgrees,       ///< ground where the mount says
  kUnseen,       ///< mounted so that the ground near by cannot be seen: the mount is not checked
  kWrongHeight,  ///< ground below the sensor, nearer or deeper than mount.height_m
  kTilted,       ///< ground below the sensor, but aslant
  kUpsideDown,   ///< ground, or most returns, above the sensor
  kRotated,      ///< the largest plane lies beside the sensor: roll or pitch, or the axes' order, are wrong
  kNoGround,  ///< no plane that could be the ground: among houses, a sensor upside down looks like that too
};

/// "agrees", "wrong height", ...
std::string_view to_string(MountFinding finding) noexcept;

/// Plain data, to be copied anywhere. The estimate is what [mount] would have to say; yaw cannot be seen from
/// the ground.
struct MountReport {
  MountFinding finding = MountFinding::kPending;
  /// What the sweeps so far say; the finding, once there is one. kPending before the first.
  MountFinding so_far = MountFinding::kPending;
  std::uint32_t num_sweeps = 0;  ///< that were looked at
  bool has_estimate = false;     ///< whether there is a plane that the next three stand for
  double height_m = 0.0, roll_rad = 0.0, pitch_rad = 0.0;
  double ground_share = 0.0;  ///< part of the near returns on that plane
  double share_above = 0.0;   ///< part of all returns that are higher than the sensor
  /// Of the sensor as [ground.height] found it and the method works with it; 0 while it has not, or is off.
  double set_height_m = 0.0;

  bool is_warning() const noexcept { return finding > MountFinding::kUnseen; }
  /// At the end of a recording: the verdict of what was seen, if fewer sweeps came than were to be looked at.
  MountReport concluded() const noexcept {
    MountReport result = *this;
    result.finding = so_far;
    return result;
  }
};

/// One sentence for the user, what is wrong and what to set; that nothing could be checked if it is kUnseen;
/// empty if there is nothing to say. [any but the hot path]
std::string to_text(const MountReport& report, const Mount& mount);

/// One line about the estimated height, with its line feed; empty while there is none. [any but the hot path]
std::string height_line(const MountReport& report, const Mount& mount);

}  // namespace pago::ground
