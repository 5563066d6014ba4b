// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/sensor_status.hpp"

namespace pago::test {

struct StatusByte {
  std::uint8_t type = 0, value = 0;
};
/// What a sensor says in its status bytes, packet by packet: 260 cycles of 16, again and again.
using StatusCycle = std::array<StatusByte, 4160>;

struct StatusOptions {
  bool is_s3 = true;  ///< 'W' and CRC-16; else an S2.1's length word, warnings near the end
  char gps = 'A';
  hdl64::SensorStatus says{};  ///< times, temperature, parameters
  std::uint8_t return_mode = 0;
};

/// The seven value bytes of each of the 260 cycles, and their types, as the manuals lay them out (hdl64
/// notes, section 5); nothing is shared with the reader.
struct StatusTable {
  StatusTable() {
    for (auto& cycle : type) cycle = {'1', '2', '3', '4', '5', '6', '7'};
  }
  void put(std::size_t byte, int number) {
    value[byte / 7][byte % 7] = static_cast<std::uint8_t>(number & 0xFF);
  }
  void put16(std::size_t byte, long number) {
    put(byte, static_cast<int>(number));
    put(byte + 1, static_cast<int>(number >> 8));
  }
  std::array<std::array<std::uint8_t, 7>, 260> value{}, type{};
};

/// CRC-16 of bytes in the table, carried on from `crc`.
inline unsigned crc16(const StatusTable& table, std::size_t from, std::size_t until, unsigned crc) {
  for (std::size_t byte = from; byte < until; ++byte) {
    crc ^= static_cast<unsigned>(table.value[byte / 7][byte % 7]) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1 ^ 0x8005U) & 0xFFFFU : crc << 1;
  }
  return crc;
}

inline void put_laser(StatusTable& table, std::size_t at, const hdl64::LaserCalibration& laser) {
  const double degree = std::numbers::pi / 180.0;
  table.put16(at + 1, std::lround(laser.vertical_rad / degree * 100.0));
  table.put16(at + 3, std::lround(laser.rotation_rad / degree * 100.0));
  table.put16(at + 5, std::lround(laser.distance_m * 1000.0));
  table.put16(at + 7, std::lround(laser.distance_x_m * 1000.0));
  table.put16(at + 9, std::lround(laser.distance_y_m * 1000.0));
  table.put16(at + 11, std::lround(laser.vertical_offset_m * 1000.0));
  table.put16(at + 13, std::lround(laser.horizontal_offset_m * 1000.0));
  table.put16(at + 15, std::lround(laser.focal_distance_m * 1000.0));
  table.put16(at + 17, std::lround(laser.focal_slope * 10.0));
  table.put(at + 19, laser.min_intensity), table.put(at + 20, laser.max_intensity);
}

/// The last four cycles: what the unit is and how it is set.
inline void put_tail(StatusTable& table, const StatusOptions& options, unsigned crc) {
  constexpr std::size_t kTail = 7 * 256;
  const hdl64::SensorStatus& says = options.says;
  for (std::size_t i = 0; i < 6; ++i) table.put(kTail + i, says.calibrated[i]);
  table.put(kTail + 6, says.humidity_percent);
  table.put16(kTail + 7, says.motor_rpm);
  table.put16(kTail + 9, says.view_start_cdeg), table.put16(kTail + 11, says.view_end_cdeg);
  table.put16(kTail + 13, says.life_hours);
  for (std::size_t i = 0; i < 4; ++i) {
    table.put(kTail + 15 + i, static_cast<int>(says.source_ipv4 >> (24 - 8 * i)));
    table.put(kTail + 19 + i, static_cast<int>(says.destination_ipv4 >> (24 - 8 * i)));
  }
  table.type[257] = {0xFE, 0xFF, 0xFC, 0xFD, 0xFA, 0xFB, '7'};
  table.type[259][2] = 0xF9, table.type[259][4] = 0xF8;
  table.put(kTail + 23, options.return_mode);
  if (!options.is_s3) table.put(kTail + 24, says.warnings);
  table.put(kTail + 25, says.power_level);
  table.put16(kTail + 26, options.is_s3 ? static_cast<long>(crc) : 1820);
}

inline StatusTable make_status_table(const hdl64::Calibration& unit, const StatusOptions& options) {
  StatusTable table;
  const hdl64::SensorStatus& says = options.says;
  for (std::size_t i = 0; i < 5; ++i) table.put(i, "UNIT#"[i]);
  table.put(5, says.upper_threshold), table.put(6, says.lower_threshold);
  table.type[0][5] = 0xF7, table.type[0][6] = 0xF6;
  unsigned crc = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::size_t at = 7 + 28 * i;
    table.put(at, static_cast<int>(i));
    put_laser(table, at, unit.lasers[i]);
    crc = crc16(table, at + 1, at + 21, crc);
    if (!options.is_s3 || i == 63) continue;
    table.type[4 + 4 * i][0] = 'W';
    table.value[4 + 4 * i][0] = says.warnings;
  }
  put_tail(table, options, crc);
  return table;
}

/// Nine bytes that come in each cycle of 16, then seven of the table.
inline StatusCycle make_status_cycle(const hdl64::Calibration& unit, const StatusOptions& options = {}) {
  const StatusTable table = make_status_table(unit, options);
  const hdl64::SensorStatus& says = options.says;
  const std::array<StatusByte, 9> front{{{'H', says.time[0]},
                                         {'M', says.time[1]},
                                         {'S', says.time[2]},
                                         {'D', says.date[0]},
                                         {'N', says.date[1]},
                                         {'Y', says.date[2]},
                                         {'G', static_cast<std::uint8_t>(options.gps)},
                                         {'T', says.temperature_c},
                                         {'V', says.firmware}}};
  StatusCycle cycle{};
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const std::size_t row = i / 16, in_cycle = i % 16;
    cycle[i] = in_cycle < 9 ? front[in_cycle]
                            : StatusByte{table.type[row][in_cycle - 9], table.value[row][in_cycle - 9]};
  }
  return cycle;
}

}  // namespace pago::test
