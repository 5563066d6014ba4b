// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "pago/hdl64/rotation_tracker.hpp"

namespace pago::hdl64 {

/// When the blocks of an S1's packets fire, which no manual tells: the mean way of the head from the first
/// block to each, over packets in order of time, divided by its speed. 64 packets are good to 2 us. Nothing
/// if the head stands, or turns too unsteadily for that. [ingest thread] real-time safe.
std::optional<BlockTimes> measure_block_times(std::span<const PacketAzimuths> packets,
                                              std::int64_t packet_period_ns) noexcept;

/// How long after its upper block a firing's lower one fires, in the mean.
std::int32_t lower_delay_ns(const PacketLayout& layout, const BlockTimes& times_ns) noexcept;

}  // namespace pago::hdl64
