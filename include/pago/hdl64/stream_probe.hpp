// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pago::hdl64 {

/// What a stream of 1,206-byte datagrams comes from.
enum class SensorKind : std::uint8_t {
  kUnknown,       ///< none of these, or not decided yet
  kHdl64Single,   ///< HDL-64E S2, S2.1 or S3, single return: what PaGO reads
  kHdl64Dual,     ///< HDL-64E S3, dual return
  kHdl64S1,       ///< HDL-64E S1: three upper blocks for each lower one
  kHdl64EarlyS2,  ///< HDL-64E S2 of 2008: text where later ones have their time stamp
  kHdl32,
  kVlp16,  ///< and its Hi-Res sibling
  kVlp32c,
  kVls128,
  kOneBank,  ///< HDL-32E, VLP-16 or VLP-32C, and nothing tells which
  kCount
};

/// "HDL-32E"
std::string_view name(SensorKind kind) noexcept;

inline bool is_supported(SensorKind kind) noexcept {
  return kind == SensorKind::kHdl64Single;
}

/// Why PaGO does not read this stream, one sentence for the user; empty for what it reads. [any thread]
/// allocates.
std::string refusal(SensorKind kind);

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
  static constexpr std::size_t kPackets = 16;

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
  static constexpr std::size_t kMaxPackets = 64;
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
