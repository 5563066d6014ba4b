// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {

/// The returns of one firing, compacted: the first `size` entries are valid, in laser order.
struct FiringReturns {
  int size = 0;
  alignas(64) std::array<float, kLasers> x_m, y_m, z_m;
  alignas(64) std::array<std::uint8_t, kLasers> intensity, ring, laser;
};

/// Where the head points: azimuth_rad(t) = azimuth_rad + rate * t for t seconds after the firing's start.
/// Clockwise positive, as the encoder counts.
struct Rotation {
  double azimuth_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// Turns raw distances into points with the two-point calibration (S3 manual p. 10; hdl64 notes section 6).
/// [set-up] constructor; [ingest thread] decode: real-time safe.
class FiringDecoder {
 public:
  FiringDecoder(const Calibration& calibration, double min_range_m, double max_range_m);

  /// Decodes one firing (0..5) of a packet; each laser at its own firing time and azimuth.
  void decode(const PacketView& packet,
              int firing,
              const Rotation& rotation,
              FiringReturns& out) const noexcept;

  /// Firing time of a laser after the start of its firing (S2.1 manual's table: groups of four every 6 us).
  static std::int32_t laser_time_ns(int laser) noexcept;

 private:
  Calibration calibration_;
  float min_range_m_, max_range_m_;
};

}  // namespace pago::hdl64
