// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/sensor_status.hpp"

#include "pago/core/text.hpp"

namespace pago::hdl64 {

PowerLevel power_level_of(const SensorStatus& status) noexcept {
  switch (status.power_level) {
    case 0xA0:
      return PowerLevel::kRaw;
    case 0xA8:
      return PowerLevel::kCorrected;
    default:
      return PowerLevel::kPlain;
  }
}

std::vector<std::string> warnings_of(const SensorStatus& status) {
  struct Words {
    Warning bit;
    const char* text;
  };
  constexpr std::array kWords{Words{kLensDirty, "clean the lens"}, Words{kTooHot, "too hot (above 58 C)"},
                              Words{kTooCold, "too cold (below 5 C)"},
                              Words{kVoltageLow, "supply voltage too low"},
                              Words{kVoltageHigh, "supply voltage too high"}};
  std::vector<std::string> result;
  for (const Words& words : kWords)
    if ((status.warnings & words.bit) != 0) result.emplace_back(words.text);
  return result;
}

std::string firmware_of(const SensorStatus& status) {
  if (status.firmware == 0) return {};
  return std::to_string(status.firmware >> 4U) + ".0" + format("%X", status.firmware & 0xFU);
}

std::string_view to_string(GpsState gps) noexcept {
  switch (gps) {
    case GpsState::kNone:
      return "none, free-running clock";
    case GpsState::kTime:
      return "time messages, no pulse";
    case GpsState::kPulse:
      return "pulse, no time messages";
    case GpsState::kFixed:
      return "pulse and time messages";
    case GpsState::kUnknown:
      break;
  }
  return "unknown";
}

std::string_view to_string(ReturnMode mode) noexcept {
  switch (mode) {
    case ReturnMode::kStrongest:
      return "strongest";
    case ReturnMode::kLast:
      return "last";
    case ReturnMode::kBoth:
      return "strongest and last";
    case ReturnMode::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace pago::hdl64
