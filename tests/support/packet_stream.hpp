// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "pago/hdl64/stream_format.hpp"
#include "support/packet_builder.hpp"

namespace pago::test {

/// A sensor in the middle of a round room, where every laser sees `raw` in every firing. The first firing of
/// packet 0 is at `azimuth_deg` and `stamp_us`; a stamp names its packet's first firing.
struct StreamSettings {
  double rotation_hz = 10.0;       ///< negative turns backwards, 0 stands
  double azimuth_deg = 180.0;      ///< true encoder angle at the first firing
  double encoder_step_deg = 0.09;  ///< headers show the last step passed; 0.01 for an ideal encoder
  std::uint32_t stamp_us = 1'799'000'000;
  std::int64_t arrival_ns = 1'700'000'000'000'000'000;  ///< of packet 0
  int raw = 4000;
  hdl64::StreamFormat format{};  ///< what kind of sensor
  int second_raw = 0;            ///< dual return: what the second blocks hold; 0: the same as the first
  int first_lower_block = 3;     ///< S1
  hdl64::BlockTimes block_times_ns = format.block_times_ns();  ///< when the blocks really fire
  /// Degrees turned t seconds after packet 0; empty: steadily at rotation_hz.
  std::function<double(double)> turned_deg{};
};

/// Makes the packets of such a stream one by one; any index may be asked for, so loss and reordering are made
/// by choosing indices.
class PacketStream {
 public:
  explicit PacketStream(const StreamSettings& settings = {}) : settings_(settings) {}

  PacketBytes packet(std::int64_t index) const {
    PacketBuilder builder;
    for (int block = 0; block < hdl64::kBlocks; ++block) write_block(builder, index, block);
    if (settings_.format.has_stamps())
      builder.stamp_us(stamp_us(index));
    else if (index % 2 == 0)
      builder.early_trailer(static_cast<std::uint16_t>(index), "V25b");
    else
      builder.early_trailer(0x1AC0, "DegC");
    return builder.bytes();
  }
  /// True encoder angle `after_ns` after packet 0, degrees in [0, 360).
  double true_azimuth_deg(std::int64_t after_ns) const {
    const double t = static_cast<double>(after_ns) * 1e-9;
    const double turned = settings_.turned_deg ? settings_.turned_deg(t) : settings_.rotation_hz * 360.0 * t;
    const double angle = std::fmod(settings_.azimuth_deg + turned, 360.0);
    return angle < 0.0 ? angle + 360.0 : angle;
  }
  std::int64_t period_ns() const { return settings_.format.packet_period_ns(); }
  std::int64_t arrival_ns(std::int64_t index) const { return settings_.arrival_ns + index * period_ns(); }

 private:
  std::uint32_t stamp_us(std::int64_t index) const {
    const std::int64_t us = settings_.stamp_us + index * period_ns() / 1000;
    return static_cast<std::uint32_t>(us % hdl64::kStampWrap_us);
  }
  void write_block(PacketBuilder& builder, std::int64_t index, int block) const {
    const bool is_s1 = settings_.format.kind == hdl64::SensorKind::kHdl64S1;
    const bool is_lower = is_s1 ? block % 4 == settings_.first_lower_block : block % 2 == 1;
    builder.flag(block, is_lower ? hdl64::kLowerBlock : hdl64::kUpperBlock);
    const std::int64_t after_ns =
        index * period_ns() + settings_.block_times_ns[static_cast<std::size_t>(block)];
    builder.block_azimuth_cdeg(block, header_azimuth_cdeg(after_ns));
    const bool is_second = settings_.format.is_dual() && block % 4 >= 2 && settings_.second_raw != 0;
    for (int laser = 0; laser < hdl64::kLasersPerBlock; ++laser)
      builder.block_slot(block, laser, is_second ? settings_.second_raw : settings_.raw,
                         is_second ? 50 : 100);
  }
  int header_azimuth_cdeg(std::int64_t after_ns) const {
    const double step = settings_.encoder_step_deg;
    const double shown_deg = std::floor(true_azimuth_deg(after_ns) / step + 1e-9) * step;
    return static_cast<int>(std::lround(shown_deg * 100.0)) % 36000;
  }
  StreamSettings settings_;
};

/// Formats of the five kinds, as the probe finds them.
inline hdl64::StreamFormat single_return() {
  return {};
}
inline hdl64::StreamFormat single_return_s3() {
  return hdl64::format_of(hdl64::SensorKind::kHdl64Single, 345'600);
}
inline hdl64::StreamFormat dual_return() {
  return hdl64::format_of(hdl64::SensorKind::kHdl64Dual, 172'800);
}
inline hdl64::StreamFormat s1() {
  return hdl64::format_of(hdl64::SensorKind::kHdl64S1, 0);
}
inline hdl64::StreamFormat early_s2() {
  return hdl64::format_of(hdl64::SensorKind::kHdl64EarlyS2, 0);
}

}  // namespace pago::test
