// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "pago/hdl64/packet.hpp"

namespace pago::test {

using PacketBytes = std::array<std::uint8_t, hdl64::kPacketBytes>;

/// Writes HDL-64E datagrams. Made, it holds a valid single-return packet without returns: azimuths and stamp
/// zero, status 'H' 0. Setters chain; `flag` and `block_azimuth_cdeg` can also break it, or make it another
/// model's. Firings are those of a single-return packet.
class PacketBuilder {
 public:
  PacketBuilder() {
    for (int block = 0; block < hdl64::kBlocks; ++block)
      flag(block, block % 2 == 0 ? hdl64::kUpperBlock : hdl64::kLowerBlock);
    status('H', 0);
  }

  PacketBuilder& flag(int block, std::uint16_t value) { return put(at(block), value); }
  PacketBuilder& block_azimuth_cdeg(int block, int azimuth) { return put(at(block) + 2, u16(azimuth)); }
  /// Both blocks of firing 0..5.
  PacketBuilder& azimuth_cdeg(int firing, int azimuth) {
    return block_azimuth_cdeg(2 * firing, azimuth).block_azimuth_cdeg(2 * firing + 1, azimuth);
  }
  /// All six firings: the first one's azimuth and the step to the next, wrapped at 36,000.
  PacketBuilder& azimuths_cdeg(int first, int step) {
    for (int firing = 0; firing < hdl64::kFirings; ++firing)
      azimuth_cdeg(firing, (first + firing * step) % 36000);
    return *this;
  }
  /// `raw` counts 2 mm without the calibration's distCorrection; 0 = no return.
  PacketBuilder& slot(int firing, int laser, int raw, int intensity = 100) {
    return block_slot(2 * firing + laser / 32, laser % 32, raw, intensity);
  }
  PacketBuilder& block_slot(int block, int laser, int raw, int intensity = 100) {
    const std::size_t byte = at(block) + 4 + 3 * static_cast<std::size_t>(laser);
    bytes_[byte + 2] = static_cast<std::uint8_t>(intensity);
    return put(byte, u16(raw));
  }
  PacketBuilder& fill(int raw, int intensity = 100) {
    for (int firing = 0; firing < hdl64::kFirings; ++firing)
      for (int laser = 0; laser < hdl64::kLasers; ++laser) slot(firing, laser, raw, intensity);
    return *this;
  }
  PacketBuilder& stamp_us(std::uint32_t stamp) { return put(1200, stamp); }
  /// The trailer of early units: a counter, then text instead of stamp and status.
  PacketBuilder& early_trailer(std::uint16_t counter, const char (&text)[5]) {
    std::memcpy(bytes_.data() + 1202, text, 4);
    return put(1200, counter);
  }
  PacketBuilder& status(char type, std::uint8_t value) {
    bytes_[1204] = static_cast<std::uint8_t>(type);
    bytes_[1205] = value;
    return *this;
  }

  const PacketBytes& bytes() const { return bytes_; }
  hdl64::PacketView view() const& { return hdl64::PacketView{bytes_}; }

 private:
  static std::size_t at(int block) { return static_cast<std::size_t>(block) * hdl64::kBlockBytes; }
  static std::uint16_t u16(int value) { return static_cast<std::uint16_t>(value); }
  template <typename T>
  PacketBuilder& put(std::size_t byte, T value) {
    std::memcpy(bytes_.data() + byte, &value, sizeof value);
    return *this;
  }
  PacketBytes bytes_{};
};

}  // namespace pago::test
