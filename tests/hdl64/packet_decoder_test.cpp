// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/packet_decoder.hpp"

#include <bit>
#include <cmath>

#include "pago/core/units.hpp"
#include "support/catch.hpp"
#include "support/packet_builder.hpp"

using namespace pago;
using namespace pago::hdl64;
using pago::test::PacketBuilder;

namespace {

/// A unit whose lasers all look level along the encoder's azimuth, without any correction.
Calibration ideal_unit() {
  Calibration calibration;
  for (std::size_t i = 0; i < 64; ++i) calibration.ring_of_laser[i] = static_cast<std::uint8_t>(63 - i);
  return calibration;
}

PacketReturns decode(const Calibration& calibration,
                     const PacketBuilder& builder,
                     const Rotation& rotation,
                     double min_range_m = 0.9) {
  PacketReturns out{};
  PacketDecoder(calibration, min_range_m, 120.0).decode(builder.view(), rotation, out);
  return out;
}

/// A laser's return in a packet that has this one return only.
struct Point {
  int size = 0;
  double x = 0, y = 0, z = 0;
  int intensity = 0;
};
Point decode_one(
    const Calibration& calibration, int laser, int raw, double azimuth_rad, int intensity = 100) {
  const PacketBuilder builder = PacketBuilder().slot(2, laser, raw, intensity);
  const FiringReturns out = decode(calibration, builder, {azimuth_rad, 0.0}).strongest[2];
  const auto i = static_cast<std::size_t>(laser);
  CHECK((out.valid & ~(std::uint64_t{1} << laser)) == 0);
  return {std::popcount(out.valid), out.x_m[i], out.y_m[i], out.z_m[i], out.intensity[i]};
}

}  // namespace

TEST_CASE("the encoder counts clockwise from straight ahead", "[hdl64][packet_decoder]") {
  const Point ahead = decode_one(ideal_unit(), 0, 5000, 0.0);
  CHECK(ahead.size == 1);
  CHECK(ahead.x == Approx(10.0));
  CHECK(ahead.y == Approx(0.0).margin(1e-5));
  CHECK(ahead.z == Approx(0.0).margin(1e-5));
  const Point right = decode_one(ideal_unit(), 63, 5000, 90.0 * kDegree);
  CHECK(right.x == Approx(0.0).margin(1e-5));
  CHECK(right.y == Approx(-10.0));
}

TEST_CASE("a positive rotation correction turns left", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[7].rotation_rad = 30.0 * kDegree;
  const Point point = decode_one(unit, 7, 5000, 0.0);
  CHECK(point.x == Approx(10.0 * std::cos(30.0 * kDegree)));
  CHECK(point.y == Approx(5.0));
}

TEST_CASE("each correction moves the point where the manual says", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  LaserCalibration& laser = unit.lasers[40];
  laser.distance_m = laser.distance_x_m = laser.distance_y_m = 1.5;
  CHECK(decode_one(unit, 40, 5000, 0.0).x == Approx(11.5));
  laser.horizontal_offset_m = 0.026;  // to the left, looking along the beam
  CHECK(decode_one(unit, 40, 5000, 0.0).y == Approx(0.026));
  CHECK(decode_one(unit, 40, 5000, 90.0 * kDegree).x == Approx(0.026));

  laser.vertical_rad = -30.0 * kDegree;
  laser.vertical_offset_m = 0.2;
  const Point vertical = decode_one(unit, 40, 5000, 0.0);
  CHECK(vertical.x == Approx(11.5 * std::cos(30.0 * kDegree)));
  CHECK(vertical.z == Approx(-11.5 * 0.5 + 0.2));
  unit.vertical_offset = VerticalOffset::kPerpendicular;
  const Point perpendicular = decode_one(unit, 40, 5000, 0.0);
  CHECK(perpendicular.x == Approx(11.5 * std::cos(30.0 * kDegree) + 0.2 * 0.5));
  CHECK(perpendicular.z == Approx(-11.5 * 0.5 + 0.2 * std::cos(30.0 * kDegree)));
}

TEST_CASE("near points are corrected by the near figures, far ones by the far one",
          "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[3].distance_m = 1.00;
  unit.lasers[3].distance_x_m = 1.03;
  unit.lasers[3].distance_y_m = 1.05;
  // Straight ahead at the near point of Y, to the right at that of X: there the near figure alone counts.
  CHECK(decode_one(unit, 3, 465, 0.0).x == Approx(0.93 + 1.05));              // yy = 1.93 m
  CHECK(decode_one(unit, 3, 700, 90.0 * kDegree).y == Approx(-1.40 - 1.03));  // xx = 2.40 m
  // At 13.485 m, half-way between 1.93 and 25.04 m, half of the difference; xx is 0 and moves nothing.
  CHECK(decode_one(unit, 3, 6243, 0.0).x == Approx(12.486 + 1.025).margin(1e-4));
  // Beyond 25 m nothing is left, though the straight line would go on.
  CHECK(decode_one(unit, 3, 11999, 45.0 * kDegree).x > 24.998 * std::sqrt(0.5) + 0.005);
  CHECK(decode_one(unit, 3, 12000, 45.0 * kDegree).x == Approx(25.0 * std::sqrt(0.5)));
  CHECK(decode_one(unit, 3, 49500, 0.0).x == Approx(100.0));
}

TEST_CASE("each laser of each firing sees the azimuth of its own time", "[hdl64][packet_decoder]") {
  const PacketBuilder builder = PacketBuilder().fill(50000);
  const double rate = 2.0 * 3.14159265358979 * 20.0;
  const PacketReturns out = decode(ideal_unit(), builder, {1.0, rate});
  for (std::size_t firing = 0; firing < kFirings; ++firing) {
    REQUIRE(out.strongest[firing].valid == ~std::uint64_t{0});
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const double after_s =
          static_cast<double>(firing) * 48e-6 + laser_time_ns(static_cast<int>(laser)) * 1e-9;
      const double azimuth = 1.0 + rate * after_s;
      CHECK(out.strongest[firing].x_m[laser] == Approx(100.0 * std::cos(azimuth)).margin(5e-5));
      CHECK(out.strongest[firing].y_m[laser] == Approx(-100.0 * std::sin(azimuth)).margin(5e-5));
    }
  }
}

TEST_CASE("returns are kept from the minimum to the maximum range, both included",
          "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[9].distance_m = 0.5;
  CHECK(decode_one(unit, 9, 199, 0.0).size == 0);    // 0.898 m
  CHECK(decode_one(unit, 9, 200, 0.0).size == 1);    // 0.9 m
  CHECK(decode_one(unit, 9, 59750, 0.0).size == 1);  // 120 m
  CHECK(decode_one(unit, 9, 59751, 0.0).size == 0);
  CHECK(decode_one(unit, 9, 65535, 0.0).size == 0);
}

TEST_CASE("no return is never a point, whatever the correction", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  for (LaserCalibration& laser : unit.lasers) laser.distance_m = 2.0;
  const PacketReturns out = decode(unit, PacketBuilder(), {}, 0.0);
  for (std::size_t firing = 0; firing < kFirings; ++firing) CHECK(out.strongest[firing].valid == 0);
}

TEST_CASE("a disabled laser gives no points", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[20].enabled = false;
  const PacketBuilder builder = PacketBuilder().fill(4000);
  CHECK(decode(unit, builder, {}).strongest[0].valid == ~(std::uint64_t{1} << 20));
}

TEST_CASE("each return has its own place and intensity", "[hdl64][packet_decoder]") {
  const PacketBuilder builder =
      PacketBuilder().slot(4, 60, 700, 6).slot(4, 2, 500, 1).slot(4, 31, 600, 255).slot(3, 10, 800, 9);
  const PacketReturns out = decode(ideal_unit(), builder, {});
  CHECK(out.strongest[3].valid == std::uint64_t{1} << 10);
  const FiringReturns& firing = out.strongest[4];
  CHECK(firing.valid == (std::uint64_t{1} << 2 | std::uint64_t{1} << 31 | std::uint64_t{1} << 60));
  const std::array<std::size_t, 3> laser{2, 31, 60};
  const std::array<int, 3> intensity{1, 255, 6};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(firing.intensity[laser[i]] == intensity[i]);
    CHECK(firing.x_m[laser[i]] == Approx(1.0 + 0.2 * static_cast<double>(i)));
  }
}

TEST_CASE("intensity follows the focal figures within the laser's limits", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[0].min_intensity = 50;  // no slope anywhere: what the sensor says passes
  CHECK(decode_one(unit, 0, 5000, 0.0, 10).intensity == 10);
  unit.lasers[0].focal_slope = 1.0;
  unit.lasers[0].focal_distance_m = 13.1;
  // 256 * 0.9^2 = 207.36; 256 * (1 - 5000 / 65535)^2 = 218.43: 11.07 are added
  CHECK(decode_one(unit, 0, 5000, 0.0, 60).intensity == 71);
  CHECK(decode_one(unit, 0, 5000, 0.0, 10).intensity == 50);
  unit.lasers[0].max_intensity = 70;
  CHECK(decode_one(unit, 0, 5000, 0.0, 60).intensity == 70);
}

TEST_CASE("raw distances of power level A0 lose the bits that are laser power", "[hdl64][packet_decoder]") {
  const PacketBuilder builder = PacketBuilder().slot(0, 5, 5007, 33);
  PacketDecoder decoder(ideal_unit(), 0.9, 120.0);
  PacketReturns out{};
  decoder.set_power_level(PowerLevel::kRaw);
  decoder.decode(builder.view(), {}, out);
  CHECK(out.strongest[0].x_m[5] == Approx(10.0));  // 5000 of 2 mm
  CHECK(out.strongest[0].intensity[5] == 33);
  decoder.set_power_level(PowerLevel::kPlain);
  decoder.decode(builder.view(), {}, out);
  CHECK(out.strongest[0].x_m[5] == Approx(10.014));
}

TEST_CASE("a return of which A0 leaves nothing is none", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[5].distance_m = 1.0;
  PacketDecoder decoder(unit, 0.9, 120.0);
  PacketReturns out{};
  decoder.set_power_level(PowerLevel::kRaw);
  decoder.decode(PacketBuilder().slot(0, 5, 7).view(), {}, out);
  CHECK(out.strongest[0].valid == 0);
}

TEST_CASE("intensities that the sensor corrected itself pass as they are", "[hdl64][packet_decoder]") {
  Calibration unit = ideal_unit();
  unit.lasers[0].focal_slope = 1.0;
  unit.lasers[0].focal_distance_m = 13.1;
  const PacketBuilder builder = PacketBuilder().slot(0, 0, 5000, 60);
  PacketDecoder decoder(unit, 0.9, 120.0);
  PacketReturns out{};
  for (const auto& [level, expected] : {std::pair{PowerLevel::kCorrected, 60}, {PowerLevel::kPlain, 71}}) {
    decoder.set_power_level(level);
    decoder.decode(builder.view(), {}, out);
    CHECK(out.strongest[0].intensity[0] == expected);
  }
}
