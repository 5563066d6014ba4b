// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/unit.hpp"

#include <array>
#include <cmath>

#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "random.hpp"

namespace pago::simulator {
namespace {

enum : std::uint64_t { kUnit = 500, kErrors };

/// The upper block's lasers from the top down; the lower block's are the same plus 32 (four of the six real
/// files that were looked at agree).
constexpr std::array<std::size_t, 32> kTopDown{29, 28, 25, 24, 3,  2,  31, 30, 27, 26, 21, 20, 17, 16, 13, 12,
                                               23, 22, 19, 18, 15, 14, 9,  8,  5,  4,  1,  0,  11, 10, 7,  6};
/// Columns of lasers in the housing, in degrees of azimuth: upper and lower block.
constexpr std::array<double, 4> kUpperFan_deg{-5.0, -1.6, 1.9, 5.4}, kLowerFan_deg{-4.3, -0.9, 1.3, 4.7};

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

hdl64::LaserCalibration made_up_laser(std::size_t rank, bool is_upper, std::size_t id) {
  Random random(kUnit, id);
  const auto& fan = is_upper ? kUpperFan_deg : kLowerFan_deg;
  // Beams of neighbouring height leave from different columns, so that the housing has room for them.
  const double fan_deg = fan[(rank + rank / 4) % fan.size()] + random.between(-0.3, 0.3);
  const double top_deg = is_upper ? 2.0 : -8.85, step_deg = is_upper ? 0.336 : 0.513;
  const double vertical_deg = top_deg - step_deg * static_cast<double>(rank) + random.between(-0.03, 0.03);
  const double far_m = random.between(1.20, 1.48);
  hdl64::LaserCalibration laser;
  laser.rotation_rad = rounded(fan_deg, 0.01) * kDegree;
  laser.vertical_rad = rounded(vertical_deg, 0.01) * kDegree;
  laser.distance_m = rounded(far_m, 0.001);
  laser.distance_x_m = rounded(far_m + random.between(-0.005, 0.07), 0.001);
  laser.distance_y_m = rounded(far_m + random.between(-0.005, 0.06), 0.001);
  // The bundle leaves the housing higher, the steeper it points down.
  laser.vertical_offset_m = rounded((is_upper ? 0.2065 : 0.133) - 0.0013 * vertical_deg, 0.001);
  laser.horizontal_offset_m = id % 2 == 0 ? 0.026 : -0.026;
  laser.focal_distance_m = rounded(is_upper ? random.between(8.0, 24.0) : random.between(2.0, 14.0), 0.5);
  laser.focal_slope = rounded(random.between(0.6, 1.6), 0.1);
  return laser;
}

void add_field(std::string& xml, const char* name, double value) {
  xml += format("\t\t\t\t<%s>%.9g</%s>\n", name, value, name);
}

template <typename ValueOf>
void add_list(std::string& xml, const char* name, ValueOf value_of) {
  xml += format("\t<%s>\n\t\t<count>64</count>\n\t\t<item_version>0</item_version>\n", name);
  for (std::size_t i = 0; i < 64; ++i) xml += format("\t\t<item>%d</item>\n", static_cast<int>(value_of(i)));
  xml += format("\t</%s>\n", name);
}

void add_laser(std::string& xml, const hdl64::LaserCalibration& laser, std::size_t id) {
  constexpr double kCentimetres = 100.0;
  xml += "\t\t<item>\n\t\t\t<px>\n";
  xml += format("\t\t\t\t<id_>%zu</id_>\n", id);
  add_field(xml, "rotCorrection_", laser.rotation_rad / kDegree);
  add_field(xml, "vertCorrection_", laser.vertical_rad / kDegree);
  add_field(xml, "distCorrection_", laser.distance_m * kCentimetres);
  add_field(xml, "distCorrectionX_", laser.distance_x_m * kCentimetres);
  add_field(xml, "distCorrectionY_", laser.distance_y_m * kCentimetres);
  add_field(xml, "vertOffsetCorrection_", laser.vertical_offset_m * kCentimetres);
  add_field(xml, "horizOffsetCorrection_", laser.horizontal_offset_m * kCentimetres);
  add_field(xml, "focalDistance_", laser.focal_distance_m * kCentimetres);
  add_field(xml, "focalSlope_", laser.focal_slope);
  xml += "\t\t\t</px>\n\t\t</item>\n";
}

}  // namespace

hdl64::Calibration made_up_unit() {
  hdl64::Calibration unit;
  for (std::size_t rank = 0; rank < kTopDown.size(); ++rank) {
    unit.lasers[kTopDown[rank]] = made_up_laser(rank, true, kTopDown[rank]);
    unit.lasers[kTopDown[rank] + 32] = made_up_laser(rank, false, kTopDown[rank] + 32);
  }
  unit.ring_of_laser = hdl64::rank_rings(unit.lasers);
  unit.two_point = true;
  unit.origin = "a made-up unit";
  return unit;
}

hdl64::Calibration imperfect(const hdl64::Calibration& file, const UnitErrors& errors, std::uint64_t seed) {
  hdl64::Calibration unit = file;
  for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
    Random random(seed, kErrors, i);
    hdl64::LaserCalibration& laser = unit.lasers[i];
    const double range_m = errors.range_m * random.normal();
    laser.distance_m += range_m;
    laser.distance_x_m += range_m;
    laser.distance_y_m += range_m;
    laser.vertical_rad += errors.angle_rad * random.normal();
    laser.rotation_rad += errors.angle_rad * random.normal();
  }
  return unit;
}

std::string calibration_xml(const hdl64::Calibration& unit) {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n<!DOCTYPE boost_serialization>\n"
      "<boost_serialization signature=\"serialization::archive\" version=\"4\">\n<DB>\n";
  xml += format("\t<distLSB_>%.9g</distLSB_>\n", unit.distance_lsb_m * 100.0);
  add_list(xml, "enabled_", [&](std::size_t i) { return unit.lasers[i].enabled; });
  add_list(xml, "minIntensity_", [&](std::size_t i) { return unit.lasers[i].min_intensity; });
  add_list(xml, "maxIntensity_", [&](std::size_t i) { return unit.lasers[i].max_intensity; });
  xml += "\t<points_>\n\t\t<count>64</count>\n\t\t<item_version>1</item_version>\n";
  for (std::size_t i = 0; i < 64; ++i) add_laser(xml, unit.lasers[i], i);
  return xml + "\t</points_>\n</DB>\n</boost_serialization>\n";
}

}  // namespace pago::simulator
