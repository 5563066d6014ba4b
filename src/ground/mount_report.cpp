// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/ground/mount_report.hpp"

#include "pago/core/text.hpp"

namespace pago::ground {
namespace {

std::string settings(const MountReport& r) {
  return format("--set mount.height_m=%.2f --set mount.roll_rad=%.3f --set mount.pitch_rad=%.3f", r.height_m,
                r.roll_rad, r.pitch_rad);
}

}  // namespace

std::string_view to_string(MountFinding finding) noexcept {
  switch (finding) {
    case MountFinding::kPending:
      return "not looked at";
    case MountFinding::kAgrees:
      return "agrees";
    case MountFinding::kUnseen:
      return "ground out of sight";
    case MountFinding::kWrongHeight:
      return "wrong height";
    case MountFinding::kTilted:
      return "tilted";
    case MountFinding::kUpsideDown:
      return "upside down";
    case MountFinding::kRotated:
      return "rotated";
    case MountFinding::kNoGround:
      return "no ground";
  }
  return "";
}

std::string to_text(const MountReport& r, const Mount& mount) {
  switch (r.finding) {
    case MountFinding::kPending:
    case MountFinding::kAgrees:
      return {};
    case MountFinding::kUnseen:
      return format(
          "mount.roll_rad is %.3f and mount.pitch_rad %.3f: a sensor mounted so does not see the ground near "
          "by, and [mount] could not be checked",
          mount.roll_rad, mount.pitch_rad);
    case MountFinding::kWrongHeight:
      return format(
          "the ground is %.2f m below the sensor, but mount.height_m is %.2f; try --set mount.height_m=%.2f",
          r.height_m, mount.height_m, r.height_m);
    case MountFinding::kTilted:
      return "the ground is aslant to the mount; try " + settings(r);
    case MountFinding::kUpsideDown:
      return format(
                 "%.0f %% of the returns are above the sensor: it seems to be upside down, or z points "
                 "down; ",
                 100.0 * r.share_above) +
             (r.has_estimate ? "try " + settings(r) : "if it is, --set mount.roll_rad=3.1416");
    case MountFinding::kRotated:
      return "the largest plane lies beside the sensor, not below it: are the axes x forward, y left, z up? "
             "if so, try " +
             settings(r);
    case MountFinding::kNoGround:
      return format(
          "no ground is seen below the sensor, where the mount has it (%.2f m): is the sensor upside down "
          "(then --set mount.roll_rad=3.1416), or mount.* wrong, or the axes not x forward, y left, z up?",
          mount.height_m);
  }
  return {};
}

std::string height_line(const MountReport& r, const Mount& mount) {
  if (!(r.set_height_m > 0.0)) return {};
  return format("height    %.2f m, estimated for the ground method; mount.height_m is %.2f\n", r.set_height_m,
                mount.height_m);
}

}  // namespace pago::ground
