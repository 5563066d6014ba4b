// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>

namespace pago {

/// One degree in radians: `deg * kDegree` is an angle in radians, `rad / kDegree` one in degrees.
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// Nanoseconds, as all of PaGO's stamps and durations count, in the unit that formulas use.
constexpr double seconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-9;
}

/// Nanoseconds in the unit that people read latencies in.
constexpr double milliseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-6;
}

}  // namespace pago
