// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {
namespace {

// Flag and azimuth of a block, as one little-endian word.
std::uint32_t block_head(std::span<const std::uint8_t> payload, int block) noexcept {
  std::uint32_t head = 0;
  std::memcpy(&head, payload.data() + static_cast<std::size_t>(block) * kBlockBytes, sizeof head);
  return head;
}

}  // namespace

PacketFault check_packet(std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() != kPacketBytes) return PacketFault::kSize;
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

}  // namespace pago::hdl64
