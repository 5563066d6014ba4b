// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pago {

/// A sensor whose field of view is limited sends nothing while it looks elsewhere. This tells such silences
/// from lost packets: they begin and end at the same angles, turn after turn. Three in succession make it
/// known; a packet from inside the sector, or three silences elsewhere, forget it. Nothing has to be set, and
/// a user who changes the limits needs not tell.
///
/// [ingest thread] real-time safe.
class BlindSector {
 public:
  /// A gap in the stream between two angles, revolutions as the head turns (unwrapped: `to` is larger), in
  /// which `firings` are missing. Returns how many of those are no loss. The third gap alike returns those of
  /// the first two as well.
  std::uint64_t note_gap(double from_rev, double to_rev, std::uint64_t firings) noexcept;
  /// A packet came from this angle.
  void note_packet(double azimuth_rev) noexcept;
  void forget() noexcept { *this = {}; }

  bool is_known() const noexcept { return hits_ >= kHits; }
  /// True if no packet that turns the head by `packet_rev` comes any more after one that ended here.
  bool begins_at(double end_rev, double packet_rev) const noexcept;
  /// Where the head is when the next packet comes, after an angle at which the silence begins.
  double end_after(double azimuth_rev) const noexcept;

 private:
  static constexpr int kHits = 3;

  double begin_rev_ = 0.0, width_rev_ = 0.0;  // begin in [0, 1)
  double latest_rev_ = 0.0;                   // how much later than that a gap has begun
  std::uint64_t doubtful_firings_ = 0;        // of gaps that may turn out to be no loss
  int hits_ = 0, misses_ = 0;
};

}  // namespace pago
