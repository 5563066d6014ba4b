// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

/// The HDL-64E's datagram on the wire (S2 manual 2008, p. 18-21; S2.1/S3 manual, appendix): 12 blocks of 100
/// bytes and a trailer of 6, little-endian. A block is 32 lasers: the upper (0-31) or the lower ones (32-63).
/// Which blocks make a firing is the stream's format (stream_format.hpp).
namespace pago::hdl64 {

static_assert(std::endian::native == std::endian::little, "packets are read in place");

inline constexpr std::size_t kPacketBytes = 1206;
inline constexpr std::size_t kBlockBytes = 100;
inline constexpr int kBlocks = 12;
inline constexpr int kLasersPerBlock = 32;
inline constexpr int kLasers = 64;
inline constexpr int kFirings = 6;                     ///< of a single-return packet
inline constexpr int kMaxFirings = 9;                  ///< of any packet: an S1's
inline constexpr std::uint16_t kUpperBlock = 0xEEFF;   ///< lasers 0-31
inline constexpr std::uint16_t kLowerBlock = 0xDDFF;   ///< lasers 32-63
inline constexpr std::uint32_t kAzimuthSteps = 36000;  ///< header azimuth counts 0.01 degrees
inline constexpr double kDistanceLsb_m = 0.002;
inline constexpr std::uint32_t kStampWrap_us = 3'600'000'000U;  ///< the device stamp starts anew every hour
/// Time between firings of one laser, S2 and S2.1: 384 laser slots at 1,333,312 per second (2008 manual,
/// appendix B; confirmed on real data: KITTI's rings).
inline constexpr std::int64_t kFiringPeriod_ns = 48'000;
inline constexpr std::int64_t kFiringPeriodS3_ns = 57'600;  ///< S3 (its manual's firing table)
inline constexpr std::int64_t kPacketPeriod_ns = kFirings * kFiringPeriod_ns;

/// A validated packet, still in the receive buffer. Firings are counted as in single-return packets.
class PacketView {
 public:
  explicit PacketView(std::span<const std::uint8_t, kPacketBytes> bytes) : bytes_(bytes) {}

  /// Header azimuth of firing 0..5, 0.01 degrees in [0, 35999], clockwise seen from above.
  std::uint16_t azimuth_cdeg(int firing) const noexcept { return u16(block(2 * firing) + 2); }
  /// Raw distance of laser 0..63 in a firing, units of kDistanceLsb_m before calibration; 0 = no return.
  std::uint16_t distance_raw(int firing, int laser) const noexcept { return u16(slot(firing, laser)); }
  std::uint8_t intensity(int firing, int laser) const noexcept { return bytes_[slot(firing, laser) + 2]; }
  std::uint16_t block_flag(int block_index) const noexcept { return u16(block(block_index)); }
  std::uint16_t block_azimuth_cdeg(int block_index) const noexcept { return u16(block(block_index) + 2); }
  /// First byte of a block's 32 three-byte slots.
  const std::uint8_t* slots(int block_index) const noexcept { return bytes_.data() + block(block_index) + 4; }
  /// Microseconds since the top of the hour by the device's clock.
  std::uint32_t stamp_us() const noexcept {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + 1200, sizeof value);
    return value;
  }
  std::uint8_t status_type() const noexcept { return bytes_[1204]; }
  std::uint8_t status_value() const noexcept { return bytes_[1205]; }

 private:
  static std::size_t block(int index) noexcept { return static_cast<std::size_t>(index) * kBlockBytes; }
  static std::size_t slot(int firing, int laser) noexcept {
    return block(2 * firing + laser / kLasersPerBlock) + 4 +
           3 * static_cast<std::size_t>(laser % kLasersPerBlock);
  }
  std::uint16_t u16(std::size_t at) const noexcept {
    std::uint16_t value = 0;
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }
  std::span<const std::uint8_t, kPacketBytes> bytes_;
};

}  // namespace pago::hdl64
