// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/block_times.hpp"

#include <cmath>

namespace pago::hdl64 {

namespace {

/// The shortest way from one azimuth to another, revolutions.
double way_rev(std::uint16_t from_cdeg, std::uint16_t to_cdeg) noexcept {
  const double way = (to_cdeg - from_cdeg) / static_cast<double>(kAzimuthSteps);
  return way - std::nearbyint(way);
}

/// Turns per packet: of neighbouring packets only, and not of damaged ones.
double mean_turn_rev(std::span<const PacketAzimuths> packets, std::int64_t packet_period_ns) noexcept {
  const double fastest = RotationTracker::kFastest_rev_s * 1e-9 * static_cast<double>(packet_period_ns);
  double sum = 0.0;
  int n = 0;
  for (std::size_t i = 1; i < packets.size(); ++i) {
    const double turn = way_rev(packets[i - 1].azimuth_cdeg[0], packets[i].azimuth_cdeg[0]);
    if (packets[i].time_ns - packets[i - 1].time_ns != packet_period_ns || std::abs(turn) > fastest) continue;
    sum += turn;
    ++n;
  }
  return n == 0 ? 0.0 : sum / n;
}

}  // namespace

std::optional<BlockTimes> measure_block_times(std::span<const PacketAzimuths> packets,
                                              std::int64_t packet_period_ns) noexcept {
  const double turn_rev = mean_turn_rev(packets, packet_period_ns);
  const double slowest = RotationTracker::kSlowest_rev_s * 1e-9 * static_cast<double>(packet_period_ns);
  if (turn_rev < slowest) return std::nullopt;
  BlockTimes times{};
  for (std::size_t block = 1; block < kBlocks; ++block) {
    double sum_rev = 0.0;
    int n = 0;
    for (const PacketAzimuths& packet : packets) {
      const double way = way_rev(packet.azimuth_cdeg[0], packet.azimuth_cdeg[block]);
      if (way < -turn_rev || way > 2.0 * turn_rev) continue;
      sum_rev += way;
      ++n;
    }
    if (n == 0) return std::nullopt;
    const double share = sum_rev / n / turn_rev;
    times[block] = static_cast<std::int32_t>(std::lround(share * static_cast<double>(packet_period_ns)));
    if (times[block] < times[block - 1]) times[block] = times[block - 1];
  }
  return times[kBlocks - 1] < packet_period_ns ? std::optional(times) : std::nullopt;
}

std::int32_t lower_delay_ns(const PacketLayout& layout, const BlockTimes& times_ns) noexcept {
  std::int64_t sum_ns = 0;
  int n = 0;
  for (int firing = 0; firing < layout.firings; ++firing) {
    const FiringBlocks& blocks = layout.blocks[static_cast<std::size_t>(firing)];
    if (blocks.lower < 0) continue;
    sum_ns +=
        times_ns[static_cast<std::size_t>(blocks.lower)] - times_ns[static_cast<std::size_t>(blocks.upper)];
    ++n;
  }
  return n == 0 ? 0 : static_cast<std::int32_t>(sum_ns / n);
}

}  // namespace pago::hdl64
