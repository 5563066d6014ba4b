// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "packet_stream.hpp"

#include <algorithm>
#include <cstring>

namespace pago::simulator {
namespace {

enum : std::uint64_t { kWire = 800 };

void put_u16(std::uint8_t* to, std::uint16_t value) {
  std::memcpy(to, &value, sizeof value);
}

/// From the last firing until a host has the datagram: 100 us on the wire, then interrupts and queues.
std::int64_t way_to_host_ns(std::uint64_t seed, std::uint64_t packet) {
  Random random(seed, kWire, packet);
  return 100'000 + static_cast<std::int64_t>(random.unit() * random.unit() * 60'000.0);
}

}  // namespace

PacketStream::PacketStream(
    Sensor& sensor, RayCaster& scene, Traffic& traffic, StatusCycle status, Settings settings)
    : sensor_(sensor),
      scene_(scene),
      traffic_(traffic),
      status_(std::move(status)),
      settings_(settings),
      slots_(Sensor::kBlock) {}

void PacketStream::write_block(SimulatedPacket& packet,
                               std::size_t block,
                               std::int64_t firing,
                               const FiringSlots& slots) const {
  const bool is_upper = block % 2 == 0;
  const std::size_t which = sensor_.timing().firings == kDualReturn.firings ? block % 4 / 2 : 0;
  std::uint8_t* const to = packet.bytes.data() + block * hdl64::kBlockBytes;
  put_u16(to, is_upper ? hdl64::kUpperBlock : hdl64::kLowerBlock);
  put_u16(to + 2, Head::shown_cdeg(sensor_.head().revolutions(sensor_.firing_s(firing))));
  for (std::size_t j = 0; j < hdl64::kLasersPerBlock; ++j) {
    const std::size_t laser = is_upper ? j : j + hdl64::kLasersPerBlock;
    // A beam with one return says it twice.
    const Slot& slot = slots[slots[which][laser].raw != 0 ? which : 0][laser];
    put_u16(to + 4 + 3 * j, slot.raw);
    to[6 + 3 * j] = slot.intensity;
    packet.labels[block * hdl64::kLasersPerBlock + j] = static_cast<std::uint16_t>(slot.label);
  }
}

void PacketStream::skip_to(std::uint64_t packet) noexcept {
  const auto per_block = static_cast<std::uint64_t>(Sensor::kBlock / sensor_.timing().firings);
  next_ = std::min(settings_.count, packet / per_block * per_block);
}

bool PacketStream::next(SimulatedPacket& packet) {
  if (next_ == settings_.count) return false;
  const FiringTiming& timing = sensor_.timing();
  const std::int64_t first = static_cast<std::int64_t>(next_) * timing.firings;
  const std::int64_t in_block = first % Sensor::kBlock;
  if (in_block == 0) sensor_.fire(first, scene_, traffic_, std::span<FiringSlots, Sensor::kBlock>(slots_));

  const std::size_t blocks_per_firing = hdl64::kBlocks / static_cast<std::size_t>(timing.firings);
  for (std::size_t block = 0; block < hdl64::kBlocks; ++block) {
    const auto k = static_cast<std::int64_t>(block / blocks_per_firing);
    write_block(packet, block, first + k, slots_[static_cast<std::size_t>(in_block + k)]);
  }
  packet.time_ns = settings_.start_ns + first * timing.period_ns;
  const std::int64_t end_ns = packet.time_ns + timing.packet_period_ns();
  packet.arrival_ns = end_ns + way_to_host_ns(settings_.seed, next_);

  const std::int64_t named_ns = settings_.stamp == PacketStamp::kFirstFiring ? packet.time_ns : end_ns;
  const auto stamp_us = static_cast<std::uint32_t>(named_ns / 1000 % hdl64::kStampWrap_us);
  std::memcpy(packet.bytes.data() + 1200, &stamp_us, sizeof stamp_us);
  const StatusByte status = status_.at(next_, packet.time_ns);
  packet.bytes[1204] = status.type;
  packet.bytes[1205] = status.value;
  ++next_;
  return true;
}

}  // namespace pago::simulator
