// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pago/hdl64/calibration.hpp"

namespace pago::simulator {

/// The last two bytes of a packet.
struct StatusByte {
  std::uint8_t type = 0, value = 0;
};

/// What the unit says of itself in the last two bytes of its packets: every 16 packets the date, GPS state,
/// temperature and firmware, then seven bytes of a text of 1,820 that holds its calibration and settings
/// (hdl64 notes, section 5; S3 manual p. 33-38). [any thread] pure.
class StatusCycle {
 public:
  /// `is_s3`: a CRC-16 over the calibration ends the text; an S2 says its length instead.
  StatusCycle(const hdl64::Calibration& file, double rotation_hz, bool is_s3, int return_mode);

  StatusByte at(std::uint64_t packet, std::int64_t time_ns) const noexcept;

  static constexpr std::size_t kCycles = 260, kBytesPerCycle = 7;

 private:
  std::array<StatusByte, kCycles * kBytesPerCycle> text_{};
};

/// CRC-16 with polynomial 0x8005 as the S3 has it: from 0, not reflected.
std::uint16_t crc16(const std::uint8_t* bytes, std::size_t size) noexcept;

}  // namespace pago::simulator
