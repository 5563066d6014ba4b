// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/blind_sector.hpp"

#include <algorithm>
#include <cmath>

namespace pago {

namespace {

/// Smaller gaps are losses: 7 packets at 10 Hz.
constexpr double kNarrowest_rev = 0.02;
/// Packets end where they are full, not where the view does: at 20 Hz up to 2.1 degrees on.
constexpr double kTolerance_rev = 0.012;

double fraction(double revolutions) noexcept {
  return revolutions - std::floor(revolutions);
}
double wrapped(double revolutions) noexcept {
  return revolutions - std::nearbyint(revolutions);
}

}  // namespace

std::uint64_t BlindSector::note_gap(double from_rev, double to_rev, std::uint64_t firings) noexcept {
  const double width_rev = to_rev - from_rev;
  if (width_rev < kNarrowest_rev) return 0;
  const bool is_alike = hits_ > 0 && std::abs(wrapped(from_rev - begin_rev_)) < kTolerance_rev &&
                        std::abs(width_rev - width_rev_) < 2.0 * kTolerance_rev;
  if (is_alike) {
    misses_ = 0;
    latest_rev_ = std::max(latest_rev_, wrapped(from_rev - begin_rev_));
    const bool was_known = is_known();
    hits_ = std::min(hits_ + 1, kHits);
    if (was_known) return firings;
    doubtful_firings_ += firings;
    return is_known() ? doubtful_firings_ : 0;
  }
  if (is_known() && ++misses_ < kHits) {
    // A loss beside or beyond the sector: its passes inside the gap are still none.
    const double until_sector_rev = fraction(begin_rev_ - from_rev + kTolerance_rev) - kTolerance_rev;
    const double passes = std::floor(width_rev - until_sector_rev - width_rev_ + 2.0 * kTolerance_rev) + 1.0;
    const double blind_rev = std::max(0.0, passes) * width_rev_;
    const double share = std::min(1.0, blind_rev / width_rev);
    return static_cast<std::uint64_t>(std::llround(share * static_cast<double>(firings)));
  }
  begin_rev_ = fraction(from_rev);
  width_rev_ = width_rev;
  latest_rev_ = 0.0;
  doubtful_firings_ = firings;
  hits_ = 1;
  misses_ = 0;
  return 0;
}

void BlindSector::note_packet(double azimuth_rev) noexcept {
  const double into_rev = fraction(azimuth_rev - begin_rev_);
  if (hits_ > 0 && into_rev > 2.0 * kTolerance_rev && into_rev < width_rev_ - 2.0 * kTolerance_rev) forget();
}

bool BlindSector::begins_at(double end_rev, double packet_rev) const noexcept {
  // A third of a packet for the encoder's steps: better too late than a packet too early.
  const double past_rev = wrapped(end_rev + 0.67 * packet_rev - begin_rev_ - latest_rev_);
  return is_known() && past_rev > 0.0 && past_rev < packet_rev;
}

double BlindSector::end_after(double azimuth_rev) const noexcept {
  return azimuth_rev + wrapped(begin_rev_ - azimuth_rev) + width_rev_;
}

}  // namespace pago
