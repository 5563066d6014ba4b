// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "support/temporary_path.hpp"

namespace pago::test {

struct KittiPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F, intensity = 0.0F;
};
using KittiScan = std::vector<KittiPoint>;

/// At an azimuth (counter-clockwise from ahead) and elevation, 20 m away over ground.
inline KittiPoint point_at(double azimuth_rad, double elevation_rad) {
  return {static_cast<float>(20.0 * std::cos(azimuth_rad)), static_cast<float>(20.0 * std::sin(azimuth_rad)),
          static_cast<float>(20.0 * std::tan(elevation_rad)), 0.5F};
}

/// 64 rings of `per_ring` points in KITTI's order, +2 to -24.8 degrees; the head turns from the rear as far
/// as `rotation_rev`.
inline KittiScan round_scan(int per_ring, double rotation_rev = 1.0) {
  KittiScan scan;
  for (int row = 0; row < 64; ++row)
    for (int k = 0; k < per_ring; ++k) {
      const double azimuth_rad = 2.0 * std::numbers::pi * (k + 0.25) / per_ring;
      const double turn_rev = std::fmod(1.5 - azimuth_rad / (2.0 * std::numbers::pi), 1.0);
      if (turn_rev <= rotation_rev)
        scan.push_back(point_at(azimuth_rad, (2.0 - row * 0.425) * std::numbers::pi / 180.0));
    }
  return scan;
}

inline void write_scan(const std::filesystem::path& file, const KittiScan& scan) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(scan.data()),
            static_cast<std::streamsize>(scan.size() * sizeof(KittiPoint)));
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// The message with which opening fails.
inline std::string kitti_refusal(const std::filesystem::path& folder, const KittiConfig& config = {}) {
  try {
    KittiSource source(folder, config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no refusal";
}

}  // namespace pago::test
