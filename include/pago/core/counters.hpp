// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace pago {

/// Why a datagram that reached the decoder was not used.
enum class PacketFault : std::uint8_t {
  kNone,
  kSize,         ///< not 1,206 bytes
  kBlockFlag,    ///< a block starts with neither EEFF nor DDFF, or they do not alternate
  kAzimuth,      ///< an azimuth beyond 359.99 degrees
  kStamp,        ///< a device stamp that fits no time around it
  kOtherSensor,  ///< from a sensor that PaGO does not read, or cannot tell
  kCount
};
std::string_view to_string(PacketFault fault) noexcept;

/// Why a sweep got no pose.
enum class SweepDrop : std::uint8_t {
  kNoFreeSweep,  ///< every sweep was in use: the consumer is stalled
  kSuperseded,   ///< newer ones were waiting (live overload)
  kCount
};
std::string_view to_string(SweepDrop drop) noexcept;

/// Every datagram that reached the decoder has exactly one fate.
struct PacketCounters {
  std::uint64_t received = 0, decoded = 0, duplicate = 0, late = 0;
  std::uint64_t filtered = 0;  ///< from another sender than the sensor's
  std::array<std::uint64_t, static_cast<std::size_t>(PacketFault::kCount)>
      bad{};                    ///< by PacketFault; [kNone] stays 0
  std::uint64_t reordered = 0;  ///< of the decoded ones: came out of order and were put right
  std::uint64_t pending = 0;  ///< held back at this moment (sensor not yet identified, order not yet certain)

  std::uint64_t bad_total() const noexcept {
    std::uint64_t sum = 0;
    for (const auto n : bad) sum += n;
    return sum;
  }
  bool balanced() const noexcept {
    return received == decoded + duplicate + late + filtered + bad_total() + pending;
  }
};

/// Firings by the device's own clock: expected between the first and the last stamp = decoded + lost + blind.
struct FiringCounters {
  std::uint64_t expected = 0, decoded = 0, lost = 0;
  std::uint64_t blind = 0;  ///< never sent: outside the field of view that the sensor is limited to
  bool balanced() const noexcept { return expected == decoded + lost + blind; }
};

/// Every sweep that was opened has exactly one fate.
struct SweepCounters {
  std::uint64_t opened = 0, posed = 0, partial = 0, in_flight = 0;
  std::array<std::uint64_t, static_cast<std::size_t>(SweepDrop::kCount)> dropped{};

  std::uint64_t dropped_total() const noexcept {
    std::uint64_t sum = 0;
    for (const auto n : dropped) sum += n;
    return sum;
  }
  bool balanced() const noexcept { return opened == posed + partial + dropped_total() + in_flight; }
};

}  // namespace pago
