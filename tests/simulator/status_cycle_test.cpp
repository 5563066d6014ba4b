// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/status_cycle.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "pago/simulator/unit.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::simulator;

namespace {

constexpr std::int64_t kTime_ns = 1'772'446'500'000'000'000;  // 2026-03-02 10:15:00 UTC

/// The seven bytes of cycle 1..260.
std::vector<StatusByte> cycle(const StatusCycle& status, std::size_t number) {
  std::vector<StatusByte> bytes;
  for (std::uint64_t i = 9; i < 16; ++i) bytes.push_back(status.at((number - 1) * 16 + i, kTime_ns));
  return bytes;
}

int i16(std::uint8_t low, std::uint8_t high) {
  return static_cast<std::int16_t>(low | high << 8);
}

}  // namespace

TEST_CASE("the checksum is the S3's", "[simulator][status]") {
  const std::string digits = "123456789";
  // CRC-16/BUYPASS of the catalogue of parametrised CRC algorithms.
  CHECK(crc16(reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()) == 0xFEE8);
}

TEST_CASE("each cycle begins with date, GPS state, temperature and firmware", "[simulator][status]") {
  const StatusCycle status(made_up_unit(), 10.0, false, 0);
  const std::vector<std::pair<char, int>> expected{{'H', 10}, {'M', 15},  {'S', 0},  {'D', 2},   {'N', 3},
                                                   {'Y', 26}, {'G', 'A'}, {'T', 36}, {'V', 0x47}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const StatusByte byte = status.at(16 * 33 + i, kTime_ns);
    CHECK(byte.type == expected[i].first);
    CHECK(byte.value == expected[i].second);
  }
  CHECK(status.at(2, kTime_ns + 59'999'999'999).value == 59);
}

TEST_CASE("the calibration in the stream is the unit's", "[simulator][status]") {
  const hdl64::Calibration unit = made_up_unit();
  const StatusCycle status(unit, 10.0, true, 0);
  const auto marker = cycle(status, 1);
  for (std::size_t i = 0; i < 5; ++i) CHECK(marker[i].value == "UNIT#"[i]);
  constexpr double kHundredth = std::numbers::pi / 18000.0;
  std::vector<std::uint8_t> summed;
  for (std::size_t laser = 0; laser < 64; ++laser) {
    std::vector<std::uint8_t> text;
    for (std::size_t part = 0; part < 3; ++part)
      for (const StatusByte& byte : cycle(status, 2 + 4 * laser + part)) text.push_back(byte.value);
    const auto& figures = unit.lasers[laser];
    CHECK(text[0] == laser);
    CHECK(std::abs(i16(text[1], text[2]) * kHundredth - figures.vertical_rad) < 1e-9);
    CHECK(std::abs(i16(text[3], text[4]) * kHundredth - figures.rotation_rad) < 1e-9);
    CHECK(i16(text[5], text[6]) * 0.001 == Approx(figures.distance_m));
    CHECK(i16(text[7], text[8]) * 0.001 == Approx(figures.distance_x_m));
    CHECK(i16(text[9], text[10]) * 0.001 == Approx(figures.distance_y_m));
    CHECK(i16(text[11], text[12]) * 0.001 == Approx(figures.vertical_offset_m));
    CHECK(i16(text[13], text[14]) * 0.001 == Approx(figures.horizontal_offset_m));
    CHECK(i16(text[15], text[16]) * 0.001 == Approx(figures.focal_distance_m));
    CHECK(i16(text[17], text[18]) * 0.1 == Approx(figures.focal_slope));
    CHECK(text[20] == 255);
    summed.insert(summed.end(), text.begin() + 1, text.end());
  }
  const auto last = cycle(status, 260);
  CHECK(last[2].type == 0xF9);
  CHECK((last[5].value | last[6].value << 8) == crc16(summed.data(), summed.size()));
  CHECK(cycle(status, 5)[0].type == 'W');
}

TEST_CASE("an S2 ends with the length of its text, and says the speed", "[simulator][status]") {
  const StatusCycle status(made_up_unit(), 12.5, false, 0);
  const auto last = cycle(status, 260), speed = cycle(status, 258);
  CHECK((last[5].value | last[6].value << 8) == 1820);
  CHECK(speed[0].type == 0xFE);
  CHECK((speed[0].value | speed[1].value << 8) == 750);
  // It goes round: cycle 261 is cycle 1.
  CHECK(status.at(260 * 16 + 9, kTime_ns).value == 'U');
}
