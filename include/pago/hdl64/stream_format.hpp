// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "pago/core/counters.hpp"
#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {

/// What a stream of 1,206-byte datagrams comes from.
enum class SensorKind : std::uint8_t {
  kUnknown,       ///< none of these, or not decided yet
  kHdl64Single,   ///< HDL-64E S2, S2.1 or S3, single return
  kHdl64Dual,     ///< HDL-64E S3, dual return
  kHdl64S1,       ///< HDL-64E S1: three upper blocks for each lower one, no time stamps
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
  return kind >= SensorKind::kHdl64Single && kind <= SensorKind::kHdl64EarlyS2;
}

/// Why PaGO does not read this stream, one sentence for the user; empty for what it reads. [any thread]
/// allocates.
std::string refusal(SensorKind kind);

/// The blocks of a packet (0..11) that hold one firing; -1: the packet has none.
struct FiringBlocks {
  std::int8_t upper = -1, lower = -1;
  std::int8_t second_upper = -1, second_lower = -1;  ///< dual return: what else the same lasers saw
};

/// Which blocks belong together. A firing of an S1 is an upper block, with the lower block that stands
/// behind it for every third of them (in front of it, where a packet starts with a lower block).
struct PacketLayout {
  int firings = 0;
  std::array<FiringBlocks, kMaxFirings> blocks{};
};

/// When the blocks of a packet fired, nanoseconds after its first one.
using BlockTimes = std::array<std::int32_t, kBlocks>;

/// How a kind of HDL-64E packs firings into packets. Single return: six firings of an upper and a lower
/// block; dual: three, each sent twice; S1: nine of an upper block, three of which have a lower one.
struct StreamFormat {
  SensorKind kind = SensorKind::kHdl64Single;
  std::int64_t firing_period_ns = kFiringPeriod_ns;

  int firings() const noexcept;  ///< of one packet
  bool is_dual() const noexcept { return kind == SensorKind::kHdl64Dual; }
  /// Early units have no time stamp: what stands there is a counter and text (2008 manual, p. 7).
  bool has_stamps() const noexcept {
    return kind == SensorKind::kHdl64Single || kind == SensorKind::kHdl64Dual;
  }
  std::int64_t packet_period_ns() const noexcept { return firings() * firing_period_ns; }
  /// A measured time between packets agrees with the format.
  bool has_period(std::int64_t period_ns) const noexcept {
    return period_ns * 100 > packet_period_ns() * 94 && period_ns * 100 < packet_period_ns() * 106;
  }
  /// Where a packet's firings are; an S1's are told by its flags.
  const PacketLayout& layout(const PacketView& packet) const noexcept;
  /// By the book. An S1's times are in no book: evenly spaced here, to be measured from its azimuths.
  BlockTimes block_times_ns() const noexcept;

  bool operator==(const StreamFormat&) const = default;
};

/// The format of a supported kind, given the measured time between its packets (0: unknown). Firings come
/// every 48.0 us (S2, S2.1) or 57.6 us (S3; sources disagree about its single-return mode), by the measure,
/// if it is near to either. S1: 2,600 packets/s.
StreamFormat format_of(SensorKind kind, std::int64_t packet_period_ns) noexcept;

/// Firing time of a laser after the start of its firing: groups of four every eighth of the period, the two
/// blocks together (S2.1 and S3 manuals' tables; hdl64 notes, section 3). Nothing is published about the S1,
/// whose lasers count as fired at once.
constexpr std::int32_t laser_time_ns(int laser, std::int64_t firing_period_ns = kFiringPeriod_ns) noexcept {
  constexpr std::array<std::int32_t, 4> kOf48{0, 1260, 2460, 3660}, kOf57{0, 1300, 2500, 3700};
  const int slot = laser % kLasersPerBlock;
  const auto& in_group_ns = firing_period_ns == kFiringPeriod_ns ? kOf48 : kOf57;
  return static_cast<std::int32_t>(firing_period_ns / 8) * (slot / 4) +
         in_group_ns[static_cast<std::size_t>(slot % 4)];
}

/// The same for every laser of a stream.
std::array<std::int32_t, kLasers> laser_times_ns(const StreamFormat& format) noexcept;

/// [ingest thread] kNone exactly when `payload` is a well-formed packet of the format: size, twelve block
/// flags in their order, every azimuth below 36,000 and, but for the S1, equal within an upper and lower
/// pair.
PacketFault check_packet(std::span<const std::uint8_t> payload, const StreamFormat& format = {}) noexcept;

}  // namespace pago::hdl64
