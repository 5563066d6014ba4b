// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pago/hdl64/stream_format.hpp"

namespace pago::hdl64 {

/// Header azimuths are the encoder's count, rounded down to its step of 0.09 degrees (4,000 per revolution).
inline constexpr double kEncoderStep_rev = 1.0 / 4000.0;

/// The header azimuths of one packet that say where the head was, and the sensor time of its first firing.
struct PacketAzimuths {
  std::int64_t time_ns = 0;
  std::array<std::uint16_t, kBlocks> azimuth_cdeg{};

  /// One per firing; of an S1, whose blocks each have their own, all twelve.
  static PacketAzimuths of(const PacketView& packet,
                           std::int64_t time_ns,
                           const StreamFormat& format = {}) noexcept;
};

/// When a packet's header azimuths were taken, after its first firing.
struct AzimuthTimes {
  int size = 0;
  std::array<double, kBlocks> after_s{};

  /// `block_times_ns` as of the format, or measured.
  static AzimuthTimes of(const StreamFormat& format, const BlockTimes& block_times_ns) noexcept;
};

/// Offsets of azimuths from a line, as sums over observations at times t (seconds after the line's origin).
struct LineMoments {
  double w = 0.0, wt = 0.0, wtt = 0.0;      ///< weight, and its moments in time
  double residual = 0.0, residual_t = 0.0;  ///< sums of the offsets (revolutions) and of offset * t

  void add(double t_s, double residual_rev) noexcept {
    w += 1.0;
    wt += t_s;
    wtt += t_s * t_s;
    residual += residual_rev;
    residual_t += residual_rev * t_s;
  }
};

/// A straight line revolutions(t), fitted by least squares with weights that fade by e every `memory_s`. Kept
/// as the line itself and the time moments of what supports it, about a moving origin: the residuals of a
/// fitted line have no moments left, so new observations add only their own.
class FadingLine {
 public:
  explicit FadingLine(double memory_s) noexcept;

  /// Begins anew with a line that nothing supports yet.
  void start(std::int64_t time_ns, double revolutions, double rate_rev_s) noexcept;
  /// Goes on from another line and what supports it; the own memory is kept.
  void follow(const FadingLine& other) noexcept;
  /// Moves the origin to `time_ns` and lets what was seen fade.
  void advance(std::int64_t time_ns) noexcept;
  /// Takes observations in, given relative to this line and its origin.
  void correct(const LineMoments& seen) noexcept;
  /// The same observations as seen from another line with the same origin.
  LineMoments relative_to(const FadingLine& other, const LineMoments& seen) const noexcept;

  double at(std::int64_t time_ns) const noexcept {
    return revolutions_ + rate_rev_s_ * (static_cast<double>(time_ns - origin_ns_) * 1e-9);
  }
  double rate_rev_s() const noexcept { return rate_rev_s_; }
  /// How many observations support the line, each counted as much as it has not faded yet.
  double weight() const noexcept { return w_; }
  std::int64_t origin_ns() const noexcept { return origin_ns_; }
  void shift(double revolutions) noexcept { revolutions_ += revolutions; }

 private:
  double memory_s_;
  std::int64_t last_step_ns_ = 0;  // most steps are alike
  double last_fade_ = 1.0;
  std::int64_t origin_ns_ = 0;
  double revolutions_ = 0.0, rate_rev_s_ = 0.0;
  double w_ = 0.0, wt_ = 0.0, wtt_ = 0.0;
};

/// Where the head points, smoother than its encoder says. Neighbouring headers differ by one or two encoder
/// steps, so a rate taken from two of them is off by up to 50 %; this fits a line through the last 25 ms of
/// headers against device time (hdl64 notes, facts 3b and 4). Lost packets do not matter, since nothing
/// counts them; azimuths that contradict the line by more than half a degree are ignored.
///
/// A line lags behind a changing speed by acceleration * memory^2. A second line with a memory of 4 ms
/// notices: when the two differ by more than encoder steps explain, the long one goes on from the short one.
/// Measured: see tests/hdl64/rotation_tracker_test.cpp.
///
/// Azimuths are unwrapped: revolutions since some multiple of the encoder's zero, growing clockwise, half a
/// step added to undo the encoder's rounding. [ingest thread] everything; real-time safe; O(1) per packet.
class RotationTracker {
 public:
  /// Slower or faster than this is not a rotation (the sensor turns at 5 to 20 Hz and may overshoot).
  static constexpr double kSlowest_rev_s = 1.0, kFastest_rev_s = 30.0;

  RotationTracker() noexcept;

  /// When the azimuths of packets are taken from now on; six of them 48 us apart unless said otherwise.
  void set_times(const AzimuthTimes& times) noexcept { times_ = times; }

  /// Fits the line through a block of packets (any order, at least one) without need of a first guess, and
  /// without being led astray by a minority of wrong ones. Until newer packets are added the line holds for
  /// the whole block, its beginning included. `same_clock` says that the block's times and those of earlier
  /// packets belong to one clock. True if the head turned on as the earlier packets foretold, so that turns
  /// count on; otherwise the count jumps forward by at most a turn more than foretold.
  bool prime(std::span<const PacketAzimuths> block, bool same_clock) noexcept;

  /// Takes a packet in. False, and no change, if every azimuth in it contradicts the line: then the head is
  /// elsewhere than thought, and only priming again helps. Packets of the priming block are recognised by
  /// their time and not added twice.
  bool add(const PacketAzimuths& packet) noexcept;

  /// The unwrapped azimuth at a time near the newest packet's.
  double revolutions(std::int64_t time_ns) const noexcept { return slow_.at(time_ns); }
  double rate_rev_s() const noexcept { return slow_.rate_rev_s(); }

  /// False before the first priming and while the head stands, starts or turns implausibly: sweeps have no
  /// meaning then.
  bool is_spinning() const noexcept {
    return primed_ && rate_rev_s() >= kSlowest_rev_s && rate_rev_s() <= kFastest_rev_s;
  }
  /// Single azimuths that were ignored because they contradict the line.
  std::uint64_t rejected() const noexcept { return rejected_; }

 private:
  static constexpr double kMemory_s = 0.025, kShortMemory_s = 0.003;

  AzimuthTimes times_;
  FadingLine slow_{kMemory_s}, fast_{kShortMemory_s};
  std::int64_t newest_ns_ = 0;
  std::uint64_t rejected_ = 0;
  bool primed_ = false;
};

}  // namespace pago::hdl64
