// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/hdl64/stream_format.hpp"

namespace pago::simulator {

/// When the lasers of a firing fire (hdl64 notes, section 3).
struct FiringTiming {
  std::int64_t period_ns = hdl64::kFiringPeriod_ns;
  int firings = hdl64::kFirings;  ///< in a packet

  std::int64_t packet_period_ns() const noexcept { return period_ns * firings; }
  std::int32_t laser_ns(int laser) const noexcept { return hdl64::laser_time_ns(laser, period_ns); }
};

inline constexpr FiringTiming kSingleReturn{};
inline constexpr FiringTiming kSingleReturnS3{hdl64::kFiringPeriodS3_ns, hdl64::kFirings};
/// S3: each firing takes two pairs of blocks, for its two returns.
inline constexpr FiringTiming kDualReturn{hdl64::kFiringPeriodS3_ns, 3};

}  // namespace pago::simulator
