// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/stream_format.hpp"

namespace pago::hdl64 {
namespace {

/// 2,600 packets/s (ros-drivers), nine upper blocks each.
constexpr std::int64_t kFiringPeriodS1_ns = 42'735;
constexpr int kBlocksPerGroupS1 = 4;  // three upper, one lower

constexpr std::int8_t block_at(int index) {
  return static_cast<std::int8_t>(index);
}

constexpr PacketLayout single_layout() {
  PacketLayout layout{.firings = kFirings, .blocks = {}};
  for (int i = 0; i < layout.firings; ++i)
    layout.blocks[static_cast<std::size_t>(i)] = {.upper = block_at(2 * i), .lower = block_at(2 * i + 1)};
  return layout;
}

constexpr PacketLayout dual_layout() {
  PacketLayout layout{.firings = kFirings / 2, .blocks = {}};
  for (int i = 0; i < layout.firings; ++i)
    layout.blocks[static_cast<std::size_t>(i)] = {.upper = block_at(4 * i),
                                                  .lower = block_at(4 * i + 1),
                                                  .second_upper = block_at(4 * i + 2),
                                                  .second_lower = block_at(4 * i + 3)};
  return layout;
}

/// An S1's packet whose first lower block is block `first_lower` (0..3).
constexpr PacketLayout s1_layout(int first_lower) {
  PacketLayout layout{.firings = 0, .blocks = {}};
  for (int block = 0; block < kBlocks; ++block) {
    const bool is_lower = block % kBlocksPerGroupS1 == first_lower;
    if (is_lower) {
      const int behind = first_lower == 0 ? layout.firings : layout.firings - 1;
      layout.blocks[static_cast<std::size_t>(behind)].lower = block_at(block);
    } else {
      layout.blocks[static_cast<std::size_t>(layout.firings++)].upper = block_at(block);
    }
  }
  return layout;
}

constexpr PacketLayout kSingle = single_layout(), kDual = dual_layout();
constexpr std::array kS1{s1_layout(0), s1_layout(1), s1_layout(2), s1_layout(3)};
static_assert(kS1[0].firings == kMaxFirings && kS1[3].firings == kMaxFirings);

struct KindName {
  std::string_view article, name;
};
constexpr std::array<KindName, static_cast<std::size_t>(SensorKind::kCount)> kNames{{
    {"a ", "sensor that PaGO does not know"},
    {"an ", "HDL-64E in single-return mode"},
    {"an ", "HDL-64E S3 in dual-return mode"},
    {"an ", "HDL-64E S1"},
    {"an ", "HDL-64E S2 of 2008"},
    {"an ", "HDL-32E"},
    {"a ", "VLP-16"},
    {"a ", "VLP-32C"},
    {"a ", "VLS-128"},
    {"an ", "HDL-32E, VLP-16 or VLP-32C"},
}};

// Flag and azimuth of a block, as one little-endian word.
std::uint32_t block_head(std::span<const std::uint8_t> payload, int block) noexcept {
  std::uint32_t head = 0;
  std::memcpy(&head, payload.data() + static_cast<std::size_t>(block) * kBlockBytes, sizeof head);
  return head;
}

PacketFault check_pairs(std::span<const std::uint8_t> payload) noexcept {
  bool flags_fit = true, azimuths_fit = true;
  for (int block = 0; block < kBlocks; block += 2) {
    const std::uint32_t upper = block_head(payload, block);
    const std::uint32_t lower = block_head(payload, block + 1);
    flags_fit &= (upper & 0xFFFFU) == kUpperBlock && (lower & 0xFFFFU) == kLowerBlock;
    azimuths_fit &= upper >> 16U < kAzimuthSteps && upper >> 16U == lower >> 16U;
  }
  if (!flags_fit) return PacketFault::kBlockFlag;
  return azimuths_fit ? PacketFault::kNone : PacketFault::kAzimuth;
}

int first_lower_block(std::span<const std::uint8_t> payload) noexcept {
  int block = 0;
  while (block < kBlocksPerGroupS1 && (block_head(payload, block) & 0xFFFFU) != kLowerBlock) ++block;
  return block;
}

PacketFault check_s1(std::span<const std::uint8_t> payload) noexcept {
  const int first_lower = first_lower_block(payload);
  bool flags_fit = first_lower < kBlocksPerGroupS1, azimuths_fit = true;
  for (int block = 0; block < kBlocks; ++block) {
    const std::uint32_t head = block_head(payload, block);
    const bool is_lower = block % kBlocksPerGroupS1 == first_lower;
    flags_fit &= (head & 0xFFFFU) == (is_lower ? kLowerBlock : kUpperBlock);
    azimuths_fit &= head >> 16U < kAzimuthSteps;
  }
  if (!flags_fit) return PacketFault::kBlockFlag;
  return azimuths_fit ? PacketFault::kNone : PacketFault::kAzimuth;
}

}  // namespace

std::string_view name(SensorKind kind) noexcept {
  return kNames[static_cast<std::size_t>(kind)].name;
}

std::string refusal(SensorKind kind) {
  if (is_supported(kind)) return {};
  const KindName& words = kNames[static_cast<std::size_t>(kind)];
  return "this stream comes from " + std::string(words.article) + std::string(words.name) +
         "; PaGO reads the HDL-64E (S1, S2, S2.1, S3)";
}

int StreamFormat::firings() const noexcept {
  if (kind == SensorKind::kHdl64S1) return kMaxFirings;
  return is_dual() ? kDual.firings : kFirings;
}

const PacketLayout& StreamFormat::layout(const PacketView& packet) const noexcept {
  if (kind != SensorKind::kHdl64S1) return is_dual() ? kDual : kSingle;
  int first_lower = 0;
  while (first_lower < kBlocksPerGroupS1 - 1 && packet.block_flag(first_lower) != kLowerBlock) ++first_lower;
  return kS1[static_cast<std::size_t>(first_lower)];
}

BlockTimes StreamFormat::block_times_ns() const noexcept {
  const int blocks_at_once = kind == SensorKind::kHdl64S1 ? 1 : kBlocks / firings();
  BlockTimes times{};
  for (int block = 0; block < kBlocks; ++block)
    times[static_cast<std::size_t>(block)] =
        static_cast<std::int32_t>(block / blocks_at_once * packet_period_ns() * blocks_at_once / kBlocks);
  return times;
}

StreamFormat format_of(SensorKind kind, std::int64_t packet_period_ns) noexcept {
  StreamFormat format{.kind = kind};
  if (kind == SensorKind::kHdl64S1) format.firing_period_ns = kFiringPeriodS1_ns;
  if (!format.has_stamps()) return format;
  for (const std::int64_t period_ns : {kFiringPeriod_ns, kFiringPeriodS3_ns}) {
    format.firing_period_ns = period_ns;
    if (format.has_period(packet_period_ns)) return format;
  }
  format.firing_period_ns = format.is_dual() ? kFiringPeriodS3_ns : kFiringPeriod_ns;
  return format;
}

std::array<std::int32_t, kLasers> laser_times_ns(const StreamFormat& format) noexcept {
  std::array<std::int32_t, kLasers> times{};
  if (format.kind == SensorKind::kHdl64S1) return times;
  for (std::size_t laser = 0; laser < kLasers; ++laser)
    times[laser] = laser_time_ns(static_cast<int>(laser), format.firing_period_ns);
  return times;
}

PacketFault check_packet(std::span<const std::uint8_t> payload, const StreamFormat& format) noexcept {
  if (payload.size() != kPacketBytes) return PacketFault::kSize;
  return format.kind == SensorKind::kHdl64S1 ? check_s1(payload) : check_pairs(payload);
}

}  // namespace pago::hdl64
