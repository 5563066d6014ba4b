// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/device_clock.hpp"

#include <cstdlib>
#include <initializer_list>

#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {

namespace {

constexpr std::int64_t kHour_us = kStampWrap_us;
constexpr std::int64_t kHour_ns = kHour_us * 1000;
/// Where the counter of a unit that free-runs past the hour overflows.
constexpr std::int64_t kCounter_us = std::int64_t{1} << 32U;
/// Within these a stamp continues the newest one whatever the host's clock says. Backwards: packets that
/// overtook each other.
constexpr std::int64_t kAhead_us = 500'000, kBehind_us = 20'000;
/// But where it is no neighbour of the newest and the host says that whole hours have passed, they have: a
/// host that was suspended. A host's clock that was set by hours shows between neighbours.
constexpr std::int64_t kNeighbour_us = 2'000, kWholeHours_us = 550'000;
/// How far device and host may disagree about the length of a silence: a constant and a drift of 1 %.
constexpr std::int64_t kDisagreement_us = 2'000'000, kDriftDivisor = 100;
/// Implausible stamps that continue each other are a clock; a damaged one has no successor, and a bunch of
/// packets that took a slower way is shorter than this.
constexpr int kDoubts = 8;
constexpr std::int64_t kSuccessor_us = 5'000;

std::int64_t nearest_multiple(std::int64_t value, std::int64_t unit) noexcept {
  const std::int64_t shifted = value + unit / 2;
  const std::int64_t quotient = shifted / unit - (shifted % unit < 0 ? 1 : 0);
  return quotient * unit;
}

/// The shortest way from one stamp to another, over the hour or the counter's end where that is shorter.
std::int64_t shortest_us(std::int64_t difference_us) noexcept {
  std::int64_t shortest = difference_us;
  for (const std::int64_t wrap : {kHour_us, -kHour_us, kCounter_us, -kCounter_us})
    if (std::abs(difference_us + wrap) < std::abs(shortest)) shortest = difference_us + wrap;
  return shortest;
}

}  // namespace

DeviceClock::Reading DeviceClock::read(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept {
  if (!started_) return start(stamp_us, arrival_ns);
  const std::int64_t difference_us = stamp_us - stamp_us_;
  std::int64_t step_us = shortest_us(difference_us);
  const std::int64_t silence_us = (arrival_ns - arrival_ns_) / 1000;
  const bool hours_passed = std::abs(step_us) > kNeighbour_us && silence_us > kHour_us / 2 &&
                            std::abs(silence_us - nearest_multiple(silence_us, kHour_us)) < kWholeHours_us;
  if (step_us < -kBehind_us || step_us > kAhead_us || hours_passed) {
    step_us = difference_us + nearest_multiple(silence_us - difference_us, kHour_us);
    const std::int64_t tolerance_us = kDisagreement_us + std::abs(silence_us) / kDriftDivisor;
    if (step_us <= 0 || std::abs(step_us - silence_us) > tolerance_us) return doubt(stamp_us, arrival_ns);
  }
  doubts_ = 0;
  const Reading reading{Verdict::kFits, time_ns_ + step_us * 1000};
  if (step_us > 0) {
    time_ns_ = reading.time_ns;
    stamp_us_ = stamp_us;
    arrival_ns_ = arrival_ns;
  }
  return reading;
}

DeviceClock::Reading DeviceClock::start(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept {
  started_ = true;
  doubts_ = 0;
  stamp_us_ = stamp_us;
  arrival_ns_ = arrival_ns;
  time_ns_ = stamp_us_ * 1000 + nearest_multiple(arrival_ns - stamp_us_ * 1000, kHour_ns);
  return {Verdict::kRestarted, time_ns_};
}

DeviceClock::Reading DeviceClock::doubt(std::uint32_t stamp_us, std::int64_t arrival_ns) noexcept {
  const std::int64_t step_us = stamp_us - doubted_us_;
  doubts_ = doubts_ > 0 && step_us > 0 && step_us <= kSuccessor_us ? doubts_ + 1 : 1;
  doubted_us_ = stamp_us;
  if (doubts_ < kDoubts) return {};
  ++restarts_;
  return start(stamp_us, arrival_ns);
}

}  // namespace pago::hdl64
