// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "pago/output/picture.hpp"

namespace pago::output {

/// A point of a saved map; metres in the map's frame.
struct PlyPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;
  std::uint8_t intensity = 0;
  std::uint8_t ground = 0;  ///< kGround or kNonGround
};

/// How a PlyPoint is stored; and back.
inline constexpr std::size_t kPlyPointBytes = 14;
void append(std::string& bytes, const PlyPoint& point);
PlyPoint ply_point(const char* bytes) noexcept;

/// What a map's file begins with, a binary little-endian PLY with the vertex properties x y z (float)
/// intensity ground (uchar); its points follow.
std::string map_header(std::uint64_t num_points);

/// A point of a scan that shows something by its colour; metres in the scan's own frame.
struct ColouredPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;
  Colour colour{};
};

/// Writes a binary little-endian PLY with the vertex properties x y z (float) red green blue (uchar): 15
/// bytes per point. Error when the file cannot be made or written. [set-up]
void write_ply(const std::filesystem::path& file, std::span<const ColouredPoint> points);

}  // namespace pago::output
