// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/unit.hpp"

#include <cmath>
#include <fstream>
#include <set>

#include "pago/core/units.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using namespace pago::simulator;

TEST_CASE("PaGO reads a unit's written calibration as it is", "[simulator][unit]") {
  const hdl64::Calibration unit = made_up_unit();
  const test::TemporaryPath file(".xml");
  std::ofstream(file.path()) << calibration_xml(unit);
  const hdl64::Calibration read = hdl64::load_calibration(file.path(), VerticalOffset::kVertical);
  REQUIRE(read.ring_of_laser == unit.ring_of_laser);
  REQUIRE(read.two_point);
  for (std::size_t i = 0; i < 64; ++i) {
    const hdl64::LaserCalibration &a = unit.lasers[i], &b = read.lasers[i];
    CHECK(std::abs(a.rotation_rad - b.rotation_rad) < 1e-10);
    CHECK(std::abs(a.vertical_rad - b.vertical_rad) < 1e-10);
    for (const auto member :
         {&hdl64::LaserCalibration::distance_m, &hdl64::LaserCalibration::distance_x_m,
          &hdl64::LaserCalibration::distance_y_m, &hdl64::LaserCalibration::vertical_offset_m,
          &hdl64::LaserCalibration::horizontal_offset_m, &hdl64::LaserCalibration::focal_distance_m,
          &hdl64::LaserCalibration::focal_slope})
      CHECK(std::abs(a.*member - b.*member) < 1e-9);
    CHECK(b.min_intensity == a.min_intensity);
    CHECK(b.max_intensity == a.max_intensity);
  }
}

TEST_CASE("the made-up unit has everything that a decoder can get wrong", "[simulator][unit]") {
  const hdl64::Calibration unit = made_up_unit();
  double lowest = 0.0, highest = 0.0, widest = 0.0;
  std::set<double> distances, rotations;
  for (const hdl64::LaserCalibration& laser : unit.lasers) {
    lowest = std::min(lowest, laser.vertical_rad);
    highest = std::max(highest, laser.vertical_rad);
    widest = std::max(widest, std::abs(laser.rotation_rad));
    distances.insert(laser.distance_m);
    rotations.insert(laser.rotation_rad);
    CHECK(laser.vertical_offset_m > 0.1);
    CHECK(std::abs(laser.horizontal_offset_m) == 0.026);
    CHECK(laser.rotation_rad != 0.0);
  }
  CHECK(lowest / kDegree == Approx(-24.8).margin(0.2));
  CHECK(highest / kDegree == Approx(2.0).margin(0.1));
  CHECK(widest / kDegree > 5.0);
  CHECK(distances.size() > 40);
  CHECK(rotations.size() > 40);
  // Upper lasers are 0 to 31.
  for (std::size_t i = 0; i < 32; ++i) CHECK(unit.lasers[i].vertical_rad > unit.lasers[i + 32].vertical_rad);
}

TEST_CASE("an imperfect unit differs from its file by what it should, and always the same",
          "[simulator][unit]") {
  const hdl64::Calibration file = made_up_unit();
  const UnitErrors errors{0.008, 0.02 * kDegree};
  const hdl64::Calibration unit = imperfect(file, errors, 5), again = imperfect(file, errors, 5);
  double range_sq = 0.0, angle_sq = 0.0;
  for (std::size_t i = 0; i < 64; ++i) {
    const double range = unit.lasers[i].distance_m - file.lasers[i].distance_m;
    range_sq += range * range;
    angle_sq += std::pow(unit.lasers[i].vertical_rad - file.lasers[i].vertical_rad, 2) +
                std::pow(unit.lasers[i].rotation_rad - file.lasers[i].rotation_rad, 2);
    CHECK(unit.lasers[i].distance_x_m - file.lasers[i].distance_x_m == Approx(range));
    CHECK(unit.lasers[i].distance_m == again.lasers[i].distance_m);
  }
  CHECK(std::sqrt(range_sq / 64) == Approx(0.008).epsilon(0.3));
  CHECK(std::sqrt(angle_sq / 128) == Approx(0.02 * kDegree).epsilon(0.3));
  CHECK(imperfect(file, errors, 6).lasers[0].distance_m != unit.lasers[0].distance_m);
  CHECK(imperfect(file, {}, 5).lasers[9].vertical_rad == file.lasers[9].vertical_rad);
}
