// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pago/hdl64/calibration.hpp"

namespace pago::hdl64 {

/// What keeps the sensor's clock (status byte G).
enum class GpsState : std::uint8_t {
  kUnknown,  ///< no status byte came yet
  kNone,     ///< free-running since power-on
  kTime,     ///< 'V': NMEA messages only
  kPulse,    ///< 'P': pulse per second only: the fraction of a second is right
  kFixed     ///< 'A': both: stamps count from the top of the hour, UTC
};

/// Which of a laser's returns the packets hold (status byte F9 of the S3).
enum class ReturnMode : std::uint8_t { kUnknown, kStrongest, kLast, kBoth };

/// Bits of SensorStatus::warnings.
enum Warning : std::uint8_t {
  kLensDirty = 1U << 0,
  kTooHot = 1U << 1,        ///< above 58 C
  kTooCold = 1U << 2,       ///< below 5 C
  kVoltageLow = 1U << 3,    ///< S2, S2.1
  kVoltageHigh = 1U << 4,   ///< S2, S2.1
  kPulsePresent = 1U << 5,  ///< no warning: PPS is there
  kGpsPresent = 1U << 6     ///< no warning: NMEA is there
};

/// What a sensor says of itself in its status bytes, the newest of each; 0 or kUnknown until it came. Plain
/// data. Early units (S1, S2 of 2008) say nothing.
struct SensorStatus {
  // Every 16 packets.
  std::array<std::uint8_t, 3> time{};  ///< hour, minute, second; by GPS, meaningless without
  std::array<std::uint8_t, 3> date{};  ///< day, month, year - 2000
  GpsState gps = GpsState::kUnknown;
  std::uint8_t temperature_c = 0;
  std::uint8_t firmware = 0;  ///< 0x47 is 4.07
  std::uint8_t warnings = 0;  ///< Warning bits

  // Every 4,160 packets.
  ReturnMode return_mode = ReturnMode::kUnknown;
  std::uint8_t power_level = 0;  ///< as sent, 0xA8; see power_level_of()
  std::uint8_t upper_threshold = 0, lower_threshold = 0;
  std::uint16_t motor_rpm = 0;  ///< as set, not as measured
  std::uint16_t view_start_cdeg = 0, view_end_cdeg = 0;
  std::uint16_t life_hours = 0;
  std::uint32_t source_ipv4 = 0, destination_ipv4 = 0;  ///< host byte order
  std::array<std::uint8_t, 6> calibrated{};             ///< year - 2000, month, day, hour, minute, second
  std::uint8_t humidity_percent = 0;

  bool operator==(const SensorStatus&) const = default;
};

/// What the power level means for decoding.
PowerLevel power_level_of(const SensorStatus& status) noexcept;

/// In words for the user, e.g. "clean the lens"; empty if nothing is the matter. [any thread] allocates.
std::vector<std::string> warnings_of(const SensorStatus& status);

/// "4.07"; empty if unknown.
std::string firmware_of(const SensorStatus& status);

/// "none: free-running"
std::string_view to_string(GpsState gps) noexcept;
std::string_view to_string(ReturnMode mode) noexcept;

}  // namespace pago::hdl64
