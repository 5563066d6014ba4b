// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pago/hdl64/stream_format.hpp"

namespace pago::hdl64 {

/// Recognises the sensor behind a stream. No packet says what sent it, and some say something wrong: an
/// HDL-64E's last two bytes change from packet to packet, a VLP-16 prototype's claim an HDL-32E. So it looks
/// at 16 packets and at facts that follow from how the sensors work: block flags, time between packets,
/// repeated azimuths (hdl64 notes, sections 0 and 1). The majority counts, so a few damaged datagrams do no
/// harm; after 64 packets without a majority, or 256 datagrams of other sizes, the sensor is unknown for
/// good.
///
/// [ingest thread] real-time safe.
class StreamProbe {
 public:
  static constexpr std::size_t kPackets = 16, kMaxPackets = 64;

  /// Looks at one more datagram; after the decision at none.
  void add(std::span<const std::uint8_t> payload, std::int64_t arrival_ns) noexcept;

  bool decided() const noexcept { return decided_; }
  SensorKind kind() const noexcept { return kind_; }

  /// Median time between neighbouring packets by the device's stamps, or by arrival if those make no sense;
  /// 0 if neither does. HDL-64E: 288 us in single-return mode, 173 us in dual.
  std::int64_t packet_period_ns() const noexcept;

 private:
  /// What the flags of a packet's twelve blocks look like.
  enum Flags : std::uint8_t { kAlternating, kMoreUpper, kUpperOnly, kFourBanks, kOther, kNumFlags };
  static constexpr std::uint32_t kMaxForeign = 256;

  static Flags classify(std::span<const std::uint8_t> packet) noexcept;
  void note_azimuths(std::span<const std::uint8_t> packet, Flags flags) noexcept;
  void decide() noexcept;
  SensorKind conclude(Flags flags) const noexcept;
  SensorKind among_hdl64() const noexcept;
  SensorKind among_one_bank() const noexcept;

  std::size_t size_ = 0;       // packets of 1,206 bytes so far
  std::uint32_t foreign_ = 0;  // datagrams of any other size
  std::array<std::uint8_t, kNumFlags> votes_{};
  std::uint8_t texts_ = 0;    // alternating packets whose trailer is text
  std::uint8_t turning_ = 0;  // packets whose azimuths are not all alike
  std::uint8_t repeats_ = 0;  // packets whose neighbouring firings share their azimuths in pairs
  std::uint8_t model_byte_ = 0;
  std::array<std::uint32_t, kMaxPackets> stamps_us_{};
  std::array<std::int64_t, kMaxPackets> arrivals_ns_{};
  SensorKind kind_ = SensorKind::kUnknown;
  bool decided_ = false;
};

}  // namespace pago::hdl64
