// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_limits.hpp"

/// A calibration file as it is written, before its figures are checked and converted: what the two formats
/// have in common.
namespace pago::hdl64 {

enum Figure : std::size_t {
  kRotation,
  kVertical,
  kDistance,
  kDistanceX,
  kDistanceY,
  kVerticalOffset,
  kHorizontalOffset,
  kFocalDistance,
  kFocalSlope,
  kMinIntensity,
  kMaxIntensity,
  kNumFigures
};

/// How a format names a figure, and its unit as a factor to radians and metres.
struct FigureName {
  const char* key;
  double unit;
};
using Dialect = std::array<FigureName, kNumFigures>;

inline constexpr Dialect kDbXml{{{"rotCorrection_", kDegree},
                                 {"vertCorrection_", kDegree},
                                 {"distCorrection_", 0.01},
                                 {"distCorrectionX_", 0.01},
                                 {"distCorrectionY_", 0.01},
                                 {"vertOffsetCorrection_", 0.01},
                                 {"horizOffsetCorrection_", 0.01},
                                 {"focalDistance_", 0.01},
                                 {"focalSlope_", 1.0},
                                 {"minIntensity_", 1.0},
                                 {"maxIntensity_", 1.0}}};
inline constexpr Dialect kRosYaml{{{"rot_correction", 1.0},
                                   {"vert_correction", 1.0},
                                   {"dist_correction", 1.0},
                                   {"dist_correction_x", 1.0},
                                   {"dist_correction_y", 1.0},
                                   {"vert_offset_correction", 1.0},
                                   {"horiz_offset_correction", 1.0},
                                   {"focal_distance", 1.0},
                                   {"focal_slope", 1.0},
                                   {"min_intensity", 1.0},
                                   {"max_intensity", 1.0}}};

/// One laser's entry, in the file's own units; a figure that the file does not give is empty.
struct LaserEntry {
  int line = 0;
  int id = -1;
  bool enabled = true;
  std::array<std::optional<double>, kNumFigures> figures{};
};

struct CalibrationFile {
  std::string name;
  Dialect dialect{};
  std::optional<double> distance_lsb_m;
  std::vector<LaserEntry> lasers;
};

/// Both throw Error (file and line) for what is not well-formed, or not a calibration at all.
CalibrationFile read_db_xml(const std::string& name, std::string_view text);
CalibrationFile read_ros_yaml(const std::string& name, std::string_view text);

/// The number that `text` holds between blanks; independent of the locale. Empty if it holds anything else or
/// is not finite.
std::optional<double> parse_number(std::string_view text) noexcept;

/// What a file says where a number is expected, short and printable: "'abc'".
std::string in_quotes(std::string_view text);

/// "db.xml:12"
std::string at_line(const std::string& name, int line);

}  // namespace pago::hdl64
