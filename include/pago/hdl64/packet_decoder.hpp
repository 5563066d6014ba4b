// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/stream_format.hpp"

namespace pago::hdl64 {

/// What the lasers saw in one firing, an entry per laser of which only the members of `valid` mean anything.
/// Frame `sensor`: x forward, y left, z up.
struct FiringReturns {
  std::uint64_t valid = 0;  ///< bit i: laser i has a return
  alignas(64) std::array<float, kLasers> x_m, y_m, z_m;
  alignas(64) std::array<std::uint8_t, kLasers> intensity;
  /// Dual return only: Echo bits (core/sweep.hpp).
  alignas(64) std::array<std::uint8_t, kLasers> echo;
};

/// A packet's returns. `strongest` are the only or the stronger ones, an entry per firing; in dual-return
/// mode `others` are those that are not the same return once more.
struct PacketReturns {
  std::array<FiringReturns, kMaxFirings> strongest;
  std::array<FiringReturns, kFirings / 2> others;
};

/// Where the head points: azimuth_rad + rate * t for t seconds after the packet's first firing. Clockwise
/// positive, as the encoder counts.
struct Rotation {
  double azimuth_rad = 0.0;
  double rate_rad_s = 0.0;
};

struct PacketLanes;  // a firing between the steps of decoding

/// Turns raw distances into points with the two-point calibration (S3 manual p. 10): each laser at its own
/// firing time and azimuth, the near correction for ranges below 25 m only, intensities corrected where the
/// calibration has focal slopes. Returns outside [min_range_m, max_range_m] and those of disabled lasers are
/// left out; range is the raw distance plus distCorrection.
///
/// Dual return is told by content, since manuals and drivers disagree about the order of the blocks: equal
/// distances are one return, which is given once; else the brighter one is the strongest (the first one if
/// both are as bright), and the farther one the last.
///
/// Points are within 0.1 mm of the same formulas in double precision, up to 131 m and 20 Hz
/// (tests/hdl64/decoder_precision_test.cpp). [set-up] constructor; [ingest thread] the rest: real-time safe.
class PacketDecoder {
 public:
  PacketDecoder(const Calibration& calibration, double min_range_m, double max_range_m);

  /// What kind of packets come from now on: single return and 48 us between firings unless said otherwise.
  void set_format(const StreamFormat& format) noexcept;
  /// Times that were measured instead of taken from a book (S1), and how long after its upper block a lower
  /// one fires.
  void set_block_times(const BlockTimes& times_ns, std::int32_t lower_delay_ns) noexcept;
  void set_power_level(PowerLevel level) noexcept;

  /// Decodes a packet that passed check_packet(). Entries of `out` beyond the format's firings are left as
  /// they are.
  void decode(const PacketView& packet, const Rotation& rotation, PacketReturns& out) noexcept;

 private:
  /// What the formulas need of each laser, worked out beforehand; an entry per laser, so that loops over
  /// lasers become vector code.
  using Lanes = std::array<float, kLasers>;
  struct alignas(64) LaserTable {
    Lanes distance_m, near_slope_x, near_slope_y;
    Lanes cos_vertical, sin_vertical, cos_rotation, sin_rotation;
    Lanes xy_offset_m, z_offset_m, horizontal_offset_m, time_s;
    Lanes focal_offset, focal_slope, min_intensity, max_intensity;
    std::array<std::int32_t, kLasers> first_far_raw;
    /// Limits of range as raw distances, so that single precision cannot move a return across one.
    std::array<std::int32_t, kLasers> first_raw, last_raw;
  };
  /// The head's direction at the start of a firing.
  struct Heading {
    float cosine, sine;
  };

  void fill_laser(const Calibration& calibration, std::size_t laser, double min_range_m, double max_range_m);
  void aim(double rate_rad_s) noexcept;
  void decode_firing(const PacketView& packet,
                     const FiringBlocks& blocks,
                     Heading heading,
                     FiringReturns& strongest,
                     FiringReturns* others) const noexcept;
  void finish(const PacketLanes& lanes, Heading heading, FiringReturns& out) const noexcept;
  void place(const std::int32_t* raw, Heading heading, FiringReturns& out) const noexcept;
  void store_intensity(const PacketLanes& lanes, FiringReturns& out) const noexcept;

  LaserTable table_{};
  /// Of each laser's direction against the head's at the start of its firing, for the packet at hand.
  alignas(64) Lanes cos_aside_{}, sin_aside_{};
  StreamFormat format_;
  BlockTimes block_times_ns_{};
  float distance_lsb_m_;
  std::int32_t distance_bits_ = 0xFFFF;  // of a raw distance that are one
  bool has_focal_slopes_ = false, corrects_intensity_ = false;
};

}  // namespace pago::hdl64
