// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "pago/assembly/self_filter.hpp"
#include "pago/core/sweep.hpp"

namespace pago {

/// Columns of a scan at 10 Hz that has no firing index. A revolution of KITTI's HDL-64E has 2,083 (10 Hz) to
/// 2,165 firings. Two per cent more give room where compensated scans are crowded, and leave two per cent of
/// the cells between neighbours empty (measured on 16 scans: half of the returns lie within 0.34 columns of
/// their azimuth, 99 % within 6.3, all within 15).
inline constexpr int kScanColumns = 2208;

/// Columns for a scan whose rotation lasted so long: the least of 2,208 x 1.1^n that holds its firings, so
/// that a speed that jitters does not change the number. Durations of no rotation (below 40 or above 250 ms)
/// give kScanColumns. [any thread] real-time safe.
int scan_columns(std::int64_t rotation_ns) noexcept;

/// How the rings of a scan were told apart; from certain to guessed.
enum class RingSource : std::uint8_t {
  kWraps,     ///< 63 wraps of the azimuth: the scan's own order
  kSegments,  ///< fewer wraps: each stretch between two got the ring nearest its mean elevation
  kElevation  ///< no such order: each point by its own elevation
};

/// Makes a sweep of a scan that is points alone, one rotation of an HDL-64E from somebody else's driver or
/// file: finds out which ring each point belongs to, gives it a column, and fills the range image.
///
/// - points: every one stays in its place. Those that are not finite (or beyond 1,000 km) and those on the
///   vehicle's own body become 0, 0, 0; these and points on the vertical axis are in no cell of the range
///   image.
/// - ring: scans in KITTI's order go ring by ring from the top, each with rising azimuth; 63 wraps tell the
///   rings apart. Scans with other counts (cropped, filtered, in another order) get rings by elevation, which
///   is right to within one ring for 96 % of KITTI's returns.
/// - column: by azimuth, clockwise from the rear, where KITTI's rotations start. Points that claim the same
///   cell move to free ones beside it, all by as little as possible and never past each other, because
///   smoothness along a ring needs their order.
///
/// [set-up] constructor allocates; [one thread] the rest, real-time safe, deterministic.
class ScanOrganizer {
 public:
  /// `max_points` at most 460,800 (5 Hz, dual return).
  explicit ScanOrganizer(std::size_t max_points, const SelfFilter& self = {});
  ~ScanOrganizer();

  /// Needs an empty sweep (Sweep::reset) with header.num_columns in [1, kMaxColumns], size in
  /// [0, max_points], x_m, y_m, z_m. Writes ring, column and the range image.
  RingSource organize(Sweep& sweep) noexcept;

  /// The same where the rings are known: needs sweep.ring too, each below kNumRings.
  void place_columns(Sweep& sweep) noexcept;

  /// Of the last sweep, per point: how far the head had turned from the rear when it looked there, clockwise,
  /// in revolutions [0, 1]; negative for points that are no returns. Valid until the next call.
  std::span<const float> turn_rev() const noexcept;

  /// Scans so far whose rings are not certain (RingSource other than kWraps).
  std::uint64_t scans_with_guessed_rings() const noexcept;
  /// Points so far that were the vehicle's own body.
  std::uint64_t self_hits() const noexcept;
  /// Returns so far that found no cell: more in one ring than there are columns.
  std::uint64_t returns_without_cell() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
