// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "pago/config/hdl64.hpp"

namespace pago::hdl64 {

/// One laser's figures, SI units (the files' degrees and centimetres converted).
struct LaserCalibration {
  double rotation_rad = 0.0;       ///< rotCorrection, positive turns left: azimuth - rotation is the true one
  double vertical_rad = 0.0;       ///< vertCorrection, up positive
  double distance_m = 0.0;         ///< distCorrection, at the far point of 25.04 m
  double distance_x_m = 0.0;       ///< distCorrectionX, at the near point of 2.40 m
  double distance_y_m = 0.0;       ///< distCorrectionY, at the near point of 1.93 m
  double vertical_offset_m = 0.0;  ///< vertOffsetCorrection
  double horizontal_offset_m = 0.0;  ///< horizOffsetCorrection
  double focal_distance_m = 0.0;
  double focal_slope = 0.0;
  std::uint8_t min_intensity = 0, max_intensity = 255;
  bool enabled = true;  ///< false: its returns are not used
};

/// What the sensor does to its distances and intensities (status byte F8 of the S3; hdl64 notes, section 5).
enum class PowerLevel : std::uint8_t {
  kPlain,     ///< a set laser power, or not known
  kRaw,       ///< A0: the three least bits of a distance are the laser's power, not distance
  kCorrected  ///< A8: intensities are corrected for range by the sensor itself
};

/// One unit's calibration.
struct Calibration {
  std::array<LaserCalibration, 64> lasers{};
  std::array<std::uint8_t, 64> ring_of_laser{};  ///< rank by vertical angle of THIS unit, 0 lowest
  double distance_lsb_m = 0.002;
  bool two_point = false;  ///< near-point figures differ from the far one's
  VerticalOffset vertical_offset = VerticalOffset::kVertical;
  PowerLevel power_level = PowerLevel::kPlain;  ///< until the stream says something else
  std::string origin;                           ///< the file it came from, or that it is the sensor's own
};

/// [set-up] Reads a Velodyne db.xml or a ROS calibration yaml; which one is told by content. What a file may
/// leave out gets its default: distance step 2 mm, near point as the far one, offsets and focal figures 0,
/// intensities 0 to 255. Throws Error with file and line for an unreadable, truncated or implausible file and
/// for other sensors' files, which it names.
Calibration load_calibration(const std::filesystem::path& path, VerticalOffset vertical_offset);

/// [any thread] Rank of each laser by vertical angle, 0 lowest; equal ones by id.
std::array<std::uint8_t, 64> rank_rings(const std::array<LaserCalibration, 64>& lasers) noexcept;

}  // namespace pago::hdl64
