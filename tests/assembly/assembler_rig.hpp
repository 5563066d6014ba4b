// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "assembly/collector.hpp"
#include "pago/assembly/assembler.hpp"

namespace pago::test {

using hdl64::FiringReturns;
using hdl64::kLasers;

inline constexpr std::int64_t kPeriod = hdl64::kFiringPeriod_ns;
inline constexpr std::int64_t kOrigin = 1'790'000'000'000'000'000;

/// Lasers that look up to 10 degrees aside, and rings that are not in laser order.
inline hdl64::Calibration skewed_calibration() {
  hdl64::Calibration calibration;
  for (int laser = 0; laser < kLasers; ++laser) {
    const auto i = static_cast<std::size_t>(laser);
    calibration.lasers[i].rotation_rad = ((laser * 37) % 201 - 100) * 0.1 * std::numbers::pi / 180.0;
    calibration.ring_of_laser[i] = static_cast<std::uint8_t>((laser * 29 + 5) % kLasers);
  }
  return calibration;
}

/// A firing in which each laser's x is its number, y its firing's, and some lasers see nothing.
inline FiringReturns returns_of(int firing, unsigned missing = 0) {
  FiringReturns returns{};
  std::mt19937 random(static_cast<unsigned>(firing));
  for (int laser = 0; laser < kLasers; ++laser) {
    if (random() % 100 < missing) continue;
    const auto i = static_cast<std::size_t>(laser);
    returns.valid |= std::uint64_t{1} << laser;
    returns.x_m[i] = static_cast<float>(laser);
    returns.y_m[i] = static_cast<float>(firing);
    returns.z_m[i] = 1.5F;
    returns.intensity[i] = static_cast<std::uint8_t>(firing);
  }
  return returns;
}

/// A head that turns steadily: firing i is at `start + i * rate * 48 us` revolutions.
struct Head {
  double rate_rev_s = 10.0;
  double start_rev = 0.5;
  unsigned missing = 10;  // percent of the returns

  Firing firing(int i) const {
    const std::int64_t after_ns = i * kPeriod;
    return {.time_ns = kOrigin + after_ns,
            .arrival_ns = kOrigin + after_ns + 1'000'000,
            .revolutions = start_rev + rate_rev_s * static_cast<double>(after_ns) * 1e-9,
            .rate_rev_s = rate_rev_s};
  }
};

struct AssemblerRig {
  explicit AssemblerRig(const AssemblyConfig& config = {},
                        std::size_t ring = 3,
                        std::uint32_t max_returns = 278'528)
      : collector(ring, max_returns), assembler(config, calibration, collector) {}
  void add(const Head& head, int begin, int end) {
    for (int i = begin; i < end; ++i) assembler.add(head.firing(i), returns_of(i, head.missing));
  }
  const SweepHeader& header(std::size_t sweep) const { return collector.sweeps.at(sweep).header; }

  hdl64::Calibration calibration = skewed_calibration();
  Collector collector;
  Assembler assembler;
};

inline AssemblyConfig cut_at(double azimuth_deg) {
  AssemblyConfig config;
  config.cut_azimuth_deg = azimuth_deg;
  return config;
}

}  // namespace pago::test
