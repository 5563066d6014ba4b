// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {

/// The returns of one firing, compacted: the first `size` entries are valid, in laser order; what follows is
/// unspecified. Frame `sensor`: x forward, y left, z up.
struct FiringReturns {
  int size = 0;
  alignas(64) std::array<float, kLasers> x_m, y_m, z_m;
  alignas(64) std::array<std::uint8_t, kLasers> intensity, ring, laser;
};

/// The raw distances that each laser's returns may have: limits of range as integers, so that single
/// precision cannot move a return across one.
struct alignas(64) ValidRange {
  std::array<std::int32_t, kLasers> first_raw, last_raw;
  std::array<std::uint8_t, kLasers> ring;
};

struct FiringLanes;  // one firing between the steps of decoding

/// Where the head points: azimuth_rad(t) = azimuth_rad + rate * t for t seconds after the firing's start.
/// Clockwise positive, as the encoder counts.
struct Rotation {
  double azimuth_rad = 0.0;
  double rate_rad_s = 0.0;
};

/// Turns raw distances into points with the two-point calibration (S3 manual p. 10): each laser at its own
/// firing time and azimuth, the near correction for ranges below 25 m only, intensities corrected where the
/// calibration has focal slopes. Returns outside [min_range_m, max_range_m] and those of disabled lasers are
/// left out; range is the raw distance plus distCorrection.
///
/// Points are within 0.1 mm of the same formulas in double precision, up to 131 m and 20 Hz
/// (tests/hdl64/firing_decoder_test.cpp). [set-up] constructor; [ingest thread] decode: real-time safe.
class FiringDecoder {
 public:
  FiringDecoder(const Calibration& calibration, double min_range_m, double max_range_m);

  /// Decodes one firing (0..5) of a packet.
  void decode(const PacketView& packet,
              int firing,
              const Rotation& rotation,
              FiringReturns& out) const noexcept;

  /// Firing time of a laser after the start of its firing: groups of four every 6 us, the two blocks together
  /// (S2.1 manual's table; hdl64 notes, section 3).
  static constexpr std::int32_t laser_time_ns(int laser) noexcept {
    constexpr std::array<std::int32_t, 4> kInGroup_ns{0, 1260, 2460, 3660};
    const int slot = laser % kLasersPerBlock;
    return 6000 * (slot / 4) + kInGroup_ns[static_cast<std::size_t>(slot % 4)];
  }

 private:
  /// What the formulas need of each laser, worked out beforehand; an entry per laser, so that loops over
  /// lasers become vector code.
  struct alignas(64) LaserTable {
    using Lanes = std::array<float, kLasers>;
    Lanes distance_m, near_slope_x, near_slope_y;
    Lanes cos_vertical, sin_vertical, cos_rotation, sin_rotation;
    Lanes xy_offset_m, z_offset_m, horizontal_offset_m, time_s;
    Lanes focal_offset, focal_slope, min_intensity, max_intensity;
    std::array<std::int32_t, kLasers> first_far_raw;
  };

  void fill_laser(const Calibration& calibration, std::size_t laser);
  void place(const Rotation& rotation, FiringLanes& lanes) const noexcept;
  void correct_intensity(FiringLanes& lanes) const noexcept;

  LaserTable table_{};
  ValidRange valid_{};
  float distance_lsb_m_;
  bool corrects_intensity_ = false;
};

}  // namespace pago::hdl64
