// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pago/hdl64/firing_decoder.hpp"
#include "pago/hdl64/packet.hpp"

namespace pago::simulator {

/// When the lasers of a firing fire (hdl64 notes, section 3).
struct FiringTiming {
  std::int64_t period_ns = hdl64::kFiringPeriod_ns;
  int firings = hdl64::kFirings;  ///< in a packet

  std::int64_t packet_period_ns() const noexcept { return period_ns * firings; }
  std::int32_t laser_ns(int laser) const noexcept {
    if (firings == hdl64::kFirings) return hdl64::FiringDecoder::laser_time_ns(laser);
    constexpr std::array<std::int32_t, 4> kInGroup_ns{0, 1300, 2500, 3700};
    const int slot = laser % hdl64::kLasersPerBlock;
    return 7200 * (slot / 4) + kInGroup_ns[static_cast<std::size_t>(slot % 4)];
  }
};

inline constexpr FiringTiming kSingleReturn{};
/// S3: each firing takes two pairs of blocks, for its two returns.
inline constexpr FiringTiming kDualReturn{57'600, 3};

}  // namespace pago::simulator
