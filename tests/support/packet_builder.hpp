// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pago/hdl64/packet.hpp"

namespace pago::test {

using PacketBytes = std::array<std::uint8_t, hdl64::kPacketBytes>;

/// Writes HDL-64E single-return datagrams. Made, it holds a valid packet without returns: azimuths and stamp
/// zero, status 'H' 0. Setters chain; `flag` and `block_azimuth_cdeg` can also break it.
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
    const std::size_t byte = at(2 * firing + laser / 32) + 4 + 3 * static_cast<std::size_t>(laser % 32);
    bytes_[byte + 2] = static_cast<std::uint8_t>(intensity);
    return put(byte, u16(raw));
  }
  PacketBuilder& fill(int raw, int intensity = 100) {
    for (int firing = 0; firing < hdl64::kFirings; ++firing)
      for (int laser = 0; laser < hdl64::kLasers; ++laser) slot(firing, laser, raw, intensity);
    return *this;
  }
  PacketBuilder& stamp_us(std::uint32_t stamp) { return put(1200, stamp); }
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

/// A sensor that turns steadily in the middle of a round room: every laser sees `raw` in every firing. The
/// first firing of packet 0 is at `azimuth_deg` and `stamp_us`; a stamp names its packet's first firing.
struct StreamSettings {
  double rotation_hz = 10.0;       ///< negative turns backwards, 0 stands
  double azimuth_deg = 180.0;      ///< true encoder angle at the first firing
  double encoder_step_deg = 0.09;  ///< headers show the last step passed; 0.01 for an ideal encoder
  std::uint32_t stamp_us = 1'799'000'000;
  std::int64_t arrival_ns = 1'700'000'000'000'000'000;  ///< of packet 0
  int raw = 4000;
};

/// Makes the packets of such a stream one by one; any index may be asked for, so loss and reordering are made
/// by choosing indices.
class PacketStream {
 public:
  explicit PacketStream(const StreamSettings& settings = {}) : settings_(settings) {}

  PacketBytes packet(std::int64_t index) const {
    PacketBuilder builder;
    builder.fill(settings_.raw).stamp_us(stamp_us(index));
    for (int firing = 0; firing < hdl64::kFirings; ++firing)
      builder.azimuth_cdeg(firing, header_azimuth_cdeg(index * hdl64::kFirings + firing));
    return builder.bytes();
  }
  /// Encoder angle at the start of a firing (6 per packet), degrees in [0, 360).
  double true_azimuth_deg(std::int64_t firing) const {
    const double turned = settings_.rotation_hz * 360.0 * 48e-6 * static_cast<double>(firing);
    const double angle = std::fmod(settings_.azimuth_deg + turned, 360.0);
    return angle < 0.0 ? angle + 360.0 : angle;
  }
  std::int64_t arrival_ns(std::int64_t index) const {
    return settings_.arrival_ns + index * hdl64::kPacketPeriod_ns;
  }

 private:
  std::uint32_t stamp_us(std::int64_t index) const {
    const std::int64_t us = settings_.stamp_us + index * hdl64::kPacketPeriod_ns / 1000;
    return static_cast<std::uint32_t>(us % hdl64::kStampWrap_us);
  }
  int header_azimuth_cdeg(std::int64_t firing) const {
    const double step = settings_.encoder_step_deg;
    const double shown_deg = std::floor(true_azimuth_deg(firing) / step + 1e-9) * step;
    return static_cast<int>(std::lround(shown_deg * 100.0)) % 36000;
  }
  StreamSettings settings_;
};

}  // namespace pago::test
