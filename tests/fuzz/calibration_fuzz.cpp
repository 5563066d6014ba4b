// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Calibration files, db.xml and yaml: refused by Error, or figures that decoding can work with.
#include <array>
#include <cmath>

#include "fuzz/fuzz.hpp"
#include "pago/core/error.hpp"
#include "pago/hdl64/calibration.hpp"

using namespace pago;

namespace {

void check(const hdl64::Calibration& calibration) {
  std::array<bool, 64> has_ring{};
  for (const std::uint8_t ring : calibration.ring_of_laser) {
    fuzz::require(ring < 64);
    has_ring[ring] = true;
  }
  for (const bool has : has_ring) fuzz::require(has);
  for (const hdl64::LaserCalibration& laser : calibration.lasers)
    fuzz::require(std::isfinite(laser.vertical_rad + laser.rotation_rad + laser.distance_m +
                                laser.distance_x_m + laser.distance_y_m + laser.vertical_offset_m +
                                laser.horizontal_offset_m + laser.focal_distance_m + laser.focal_slope));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file;
  try {
    check(hdl64::load_calibration(file.hold({data, size}), VerticalOffset::kVertical));
  } catch (const Error&) {
  }
  return 0;
}
