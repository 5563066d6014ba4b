// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "status_cycle.hpp"

#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

namespace pago::simulator {
namespace {

constexpr std::size_t kCyclePackets = 16;
constexpr std::uint8_t kFirmware = 0x47;  // 4.07

class Bytes {
 public:
  void u8(int value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
  void i16(double value) {
    const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value)));
    u8(word & 0xFF);
    u8(word >> 8);
  }
  const std::vector<std::uint8_t>& all() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// A laser's 21 bytes: its number, then hundredths of a degree and millimetres.
Bytes laser_text(const hdl64::LaserCalibration& laser, int id) {
  constexpr double kHundredths = 100.0 * 180.0 / std::numbers::pi, kMillimetres = 1000.0;
  Bytes text;
  text.u8(id);
  text.i16(laser.vertical_rad * kHundredths);
  text.i16(laser.rotation_rad * kHundredths);
  for (const double metres : {laser.distance_m, laser.distance_x_m, laser.distance_y_m,
                              laser.vertical_offset_m, laser.horizontal_offset_m, laser.focal_distance_m})
    text.i16(metres * kMillimetres);
  text.i16(laser.focal_slope * 10.0);
  text.u8(laser.min_intensity);
  text.u8(laser.max_intensity);
  return text;
}

using Types = std::array<std::uint8_t, StatusCycle::kBytesPerCycle>;
constexpr Types kCount{'1', '2', '3', '4', '5', '6', '7'};

}  // namespace

std::uint16_t crc16(const std::uint8_t* bytes, std::size_t size) noexcept {
  std::uint32_t crc = 0;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= std::uint32_t{bytes[i]} << 8U;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x8005U : crc << 1U;
    crc &= 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

StatusCycle::StatusCycle(const hdl64::Calibration& file, double rotation_hz, bool is_s3, int return_mode) {
  std::size_t cycle = 0;
  const auto put = [&](const Types& types, const std::vector<std::uint8_t>& values) {
    for (std::size_t i = 0; i < kBytesPerCycle; ++i)
      text_[cycle * kBytesPerCycle + i] = {types[i], values[i]};
    ++cycle;
  };
  std::vector<std::uint8_t> summed;
  put({'1', '2', '3', '4', '5', 0xF7, 0xF6}, {'U', 'N', 'I', 'T', '#', 230, 20});
  for (int id = 0; id < 64; ++id) {
    const std::vector<std::uint8_t> laser = laser_text(file.lasers[static_cast<std::size_t>(id)], id).all();
    summed.insert(summed.end(), laser.begin() + 1, laser.end());
    for (std::ptrdiff_t part = 0; part < 21; part += 7)
      put(kCount, {laser.begin() + part, laser.begin() + part + 7});
    constexpr std::uint8_t kPulsesAndGps = 0x60;  // no warning; PPS and GPS present
    Types types = kCount;
    types[0] = is_s3 ? 'W' : '1';
    if (id < 63) put(types, {is_s3 ? kPulsesAndGps : std::uint8_t{0}, 0, 0, 0, 0, 0, 0});
  }
  const auto rpm = static_cast<unsigned>(std::lround(60.0 * rotation_hz));
  constexpr unsigned kFullTurn = 36000;
  put(kCount, {26, 1, 15, 9, 30, 0, 45});  // calibrated on 2026-01-15 at 9:30:00, 45 % humidity
  put({0xFE, 0xFF, 0xFC, 0xFD, 0xFA, 0xFB, '7'},
      {static_cast<std::uint8_t>(rpm & 0xFFU), static_cast<std::uint8_t>(rpm >> 8U), 0, 0, kFullTurn & 0xFFU,
       kFullTurn >> 8U, 120});
  put(kCount, {0, 192, 168, 3, 43, 192, 168});
  const unsigned check = is_s3 ? crc16(summed.data(), summed.size()) : kCycles * kBytesPerCycle;
  put({'1', '2', 0xF9, '4', 0xF8, '6', '7'},
      {3, 255, static_cast<std::uint8_t>(return_mode), 0, 0xA8, static_cast<std::uint8_t>(check & 0xFFU),
       static_cast<std::uint8_t>(check >> 8U)});
}

StatusByte StatusCycle::at(std::uint64_t packet, std::int64_t time_ns) const noexcept {
  using namespace std::chrono;
  const std::size_t place = packet % kCyclePackets, cycle = packet / kCyclePackets % kCycles;
  if (place >= 9) return text_[cycle * kBytesPerCycle + place - 9];
  const sys_time<nanoseconds> now{nanoseconds(time_ns)};
  const auto midnight = floor<days>(now);
  const hh_mm_ss clock{floor<std::chrono::seconds>(now - midnight)};
  const year_month_day date{midnight};
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  const std::array<StatusByte, 9> said{{{'H', byte(clock.hours().count())},
                                        {'M', byte(clock.minutes().count())},
                                        {'S', byte(clock.seconds().count())},
                                        {'D', byte(static_cast<unsigned>(date.day()))},
                                        {'N', byte(static_cast<unsigned>(date.month()))},
                                        {'Y', byte(static_cast<int>(date.year()) - 2000)},
                                        {'G', 'A'},
                                        {'T', 36},
                                        {'V', kFirmware}}};
  return said[place];
}

}  // namespace pago::simulator
