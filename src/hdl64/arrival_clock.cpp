// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/arrival_clock.hpp"

#include <algorithm>
#include <cmath>

namespace pago::hdl64 {

namespace {

/// At rest, and where the host's clock was set back: longer silences are gaps.
constexpr double kSilence_s = 0.02;
/// A packet that comes this late is taken for one that was overtaken; behind it the host's clock has stepped.
constexpr double kOvertaken = 64.0;
/// How much a packet's own turn counts in the smoothed one: 32 packets are 9 ms.
constexpr double kGain = 1.0 / 32.0;
/// Turns over more periods than this say nothing about the present speed.
constexpr std::int64_t kRecent = 8;

/// The way from one azimuth to another, clockwise: [0, 1) revolutions.
double turned(std::uint16_t from_cdeg, std::uint16_t to_cdeg) noexcept {
  const int difference = to_cdeg - from_cdeg;
  const int steps = static_cast<int>(kAzimuthSteps);
  return (difference < 0 ? difference + steps : difference) / static_cast<double>(kAzimuthSteps);
}

}  // namespace

void ArrivalClock::set_format(const StreamFormat& format, const AzimuthTimes& times) noexcept {
  packet_period_ns_ = format.packet_period_ns();
  last_sample_ = times.size - 1;
  samples_share_ =
      times.after_s[static_cast<std::size_t>(last_sample_)] * 1e9 / static_cast<double>(packet_period_ns_);
}

std::int64_t ArrivalClock::read(const PacketAzimuths& azimuths, std::int64_t arrival_ns) noexcept {
  const std::uint16_t first = azimuths.azimuth_cdeg[0];
  if (!started_) {
    started_ = true;
    time_ns_ = arrival_ns - packet_period_ns_;  // it is sent behind its last firing
    turn_rev_ = turned(first, azimuths.azimuth_cdeg[static_cast<std::size_t>(last_sample_)]) / samples_share_;
  } else {
    const double turned_rev = turned(azimuth_cdeg_, first);
    const double elapsed =
        static_cast<double>(arrival_ns - arrival_ns_) / static_cast<double>(packet_period_ns_);
    const std::int64_t n = periods(turned_rev, elapsed);
    if (n <= 0) return time_ns_ + n * packet_period_ns_;
    time_ns_ += n * packet_period_ns_;
    if (n <= kRecent) turn_rev_ += kGain * (turned_rev / static_cast<double>(n) - turn_rev_);
  }
  arrival_ns_ = arrival_ns;
  azimuth_cdeg_ = first;
  return time_ns_;
}

// Whole turns are those that bring the head's way nearest to the time that has passed.
std::int64_t ArrivalClock::periods(double turned_rev, double elapsed) const noexcept {
  const double slowest = RotationTracker::kSlowest_rev_s * 1e-9 * static_cast<double>(packet_period_ns_);
  const double silence = kSilence_s * 1e9 / static_cast<double>(packet_period_ns_);
  if (turn_rev_ < slowest) return elapsed > silence ? std::llround(elapsed) : 1;
  double turns = std::round(elapsed * turn_rev_ - turned_rev);
  if ((turned_rev + turns) / turn_rev_ < -kOvertaken) turns = turned_rev > 0.5 ? -1.0 : 0.0;
  return std::llround((turned_rev + turns) / turn_rev_);
}

}  // namespace pago::hdl64
