// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/rotation_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/units.hpp"

namespace pago::hdl64 {

namespace {

/// An azimuth this far from the line is wrong (a damaged packet) or the line is.
constexpr double kGate_rev = 0.5 / 360.0;
/// Wider gate for the first guess: a rate from within packets is good to one encoder step per packet length.
constexpr double kFirstGate_rev = kEncoderStep_rev;
/// Lines farther apart than this differ because the speed changes: at a steady speed rounding parts them by a
/// tenth of a step, except within 0.5 % of speeds that advance whole steps per firing (10.417 Hz and its
/// multiples), where rounding repeats itself and no fit can do better than half a step.
constexpr double kReseed_rev = 0.25 * kEncoderStep_rev;
/// After a gap: a line that fits this well to the turns counted so far continues them.
constexpr double kContinues_rev = 0.05;
/// A first guess looks at no more packets than this.
constexpr std::size_t kMaxGuesses = 64;

/// To the nearest turn: [-1/2, 1/2].
double wrapped(double revolutions) noexcept {
  return revolutions - std::nearbyint(revolutions);
}

double encoder_rev(const PacketAzimuths& packet, int sample) noexcept {
  return packet.azimuth_cdeg[static_cast<std::size_t>(sample)] * (1.0 / kAzimuthSteps) +
         0.5 * kEncoderStep_rev;
}

double span_s(const AzimuthTimes& times) noexcept {
  return times.after_s[static_cast<std::size_t>(times.size - 1)];
}

/// The speed as most packets see it between their own first and last azimuth.
double median_rate_rev_s(const AzimuthTimes& times, std::span<const PacketAzimuths> block) noexcept {
  std::array<double, kMaxGuesses> rates;
  const std::size_t n = std::min(block.size(), kMaxGuesses);
  for (std::size_t i = 0; i < n; ++i) {
    const double turned = wrapped(encoder_rev(block[i], times.size - 1) - encoder_rev(block[i], 0));
    rates[i] = turned / span_s(times);
  }
  const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(rates.begin(), middle, rates.begin() + static_cast<std::ptrdiff_t>(n));
  return *middle;
}

/// Adds those azimuths of a packet that lie within `gate_rev` of the line to `seen`; returns their number.
int collect(const FadingLine& line,
            const AzimuthTimes& times,
            const PacketAzimuths& packet,
            double gate_rev,
            LineMoments& seen) noexcept {
  const double first_t_s = seconds(packet.time_ns - line.origin_ns());
  const double first_rev = line.at(packet.time_ns);
  int fitting = 0;
  for (int i = 0; i < times.size; ++i) {
    const double offset_s = times.after_s[static_cast<std::size_t>(i)];
    const double expected = first_rev + line.rate_rev_s() * offset_s;
    const double residual = wrapped(encoder_rev(packet, i) - expected);
    if (std::abs(residual) > gate_rev) continue;
    seen.add(first_t_s + offset_s, residual);
    ++fitting;
  }
  return fitting;
}

/// Azimuths of the block within a gate that widens with the distance from the line's origin.
int collect(const FadingLine& line,
            const AzimuthTimes& times,
            std::span<const PacketAzimuths> block,
            double gate_rev,
            double gate_rev_s,
            LineMoments& seen) noexcept {
  int fitting = 0;
  for (const PacketAzimuths& packet : block) {
    const double gate = gate_rev + gate_rev_s * std::abs(seconds(packet.time_ns - line.origin_ns()));
    fitting += collect(line, times, packet, gate, seen);
  }
  return fitting;
}

/// The line at the median speed through one of the block's packets, the one that most azimuths agree with.
FadingLine first_guess(FadingLine line,
                       const AzimuthTimes& times,
                       std::span<const PacketAzimuths> block) noexcept {
  const double rate_rev_s = median_rate_rev_s(times, block);
  FadingLine best = line;
  int most = -1;
  for (std::size_t i = 0; i < block.size(); i += 1 + block.size() / 8) {
    line.start(block[i].time_ns, encoder_rev(block[i], 0), rate_rev_s);
    LineMoments unused;
    const int fitting = collect(line, times, block, kFirstGate_rev, kEncoderStep_rev / span_s(times), unused);
    if (fitting <= most) continue;
    most = fitting;
    best = line;
  }
  return best;
}

}  // namespace

PacketAzimuths PacketAzimuths::of(const PacketView& packet,
                                  std::int64_t time_ns,
                                  const StreamFormat& format) noexcept {
  PacketAzimuths result{.time_ns = time_ns};
  const int blocks_apart = format.kind == SensorKind::kHdl64S1 ? 1 : kBlocks / format.firings();
  for (int block = 0; block < kBlocks; block += blocks_apart)
    result.azimuth_cdeg[static_cast<std::size_t>(block / blocks_apart)] = packet.block_azimuth_cdeg(block);
  return result;
}

AzimuthTimes AzimuthTimes::of(const StreamFormat& format, const BlockTimes& block_times_ns) noexcept {
  AzimuthTimes times;
  const int blocks_apart = format.kind == SensorKind::kHdl64S1 ? 1 : kBlocks / format.firings();
  for (int block = 0; block < kBlocks; block += blocks_apart)
    times.after_s[static_cast<std::size_t>(times.size++)] =
        1e-9 * block_times_ns[static_cast<std::size_t>(block)];
  return times;
}

FadingLine::FadingLine(double memory_s) noexcept : memory_s_(memory_s) {}

void FadingLine::start(std::int64_t time_ns, double revolutions, double rate_rev_s) noexcept {
  origin_ns_ = time_ns;
  revolutions_ = revolutions;
  rate_rev_s_ = rate_rev_s;
  w_ = wt_ = wtt_ = 0.0;
}

void FadingLine::follow(const FadingLine& other) noexcept {
  const double memory_s = memory_s_;
  *this = other;
  memory_s_ = memory_s;
  last_step_ns_ = 0;
  last_fade_ = 1.0;
}

void FadingLine::advance(std::int64_t time_ns) noexcept {
  const std::int64_t dt_ns = time_ns - origin_ns_;
  const double dt = seconds(dt_ns);
  if (dt_ns != last_step_ns_) {
    last_step_ns_ = dt_ns;
    last_fade_ = std::exp(-dt / memory_s_);
  }
  const double fade = last_fade_;
  revolutions_ += rate_rev_s_ * dt;
  origin_ns_ = time_ns;
  wtt_ = fade * (wtt_ - dt * (2.0 * wt_ - dt * w_));
  wt_ = fade * (wt_ - dt * w_);
  w_ = fade * w_;
}

void FadingLine::correct(const LineMoments& seen) noexcept {
  w_ += seen.w;
  wt_ += seen.wt;
  wtt_ += seen.wtt;
  const double determinant = w_ * wtt_ - wt_ * wt_;
  if (determinant <= 0.0) return;
  const double scale = 1.0 / determinant;
  revolutions_ += scale * (wtt_ * seen.residual - wt_ * seen.residual_t);
  rate_rev_s_ += scale * (w_ * seen.residual_t - wt_ * seen.residual);
}

LineMoments FadingLine::relative_to(const FadingLine& other, const LineMoments& seen) const noexcept {
  const double offset = revolutions_ - other.revolutions_, slope = rate_rev_s_ - other.rate_rev_s_;
  LineMoments result = seen;
  result.residual += offset * seen.w + slope * seen.wt;
  result.residual_t += offset * seen.wt + slope * seen.wtt;
  return result;
}

RotationTracker::RotationTracker() noexcept {
  const StreamFormat format;
  times_ = AzimuthTimes::of(format, format.block_times_ns());
}

bool RotationTracker::prime(std::span<const PacketAzimuths> block, bool same_clock) noexcept {
  const auto [oldest, newest] = std::minmax_element(
      block.begin(), block.end(), [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  const double counted = revolutions(newest_ns_), foretold = revolutions(oldest->time_ns);
  const bool could_foretell = is_spinning() && same_clock;

  FadingLine line = first_guess(slow_, times_, block);
  LineMoments wide;
  collect(line, times_, block, kFirstGate_rev, kEncoderStep_rev / span_s(times_), wide);
  line.correct(wide);
  line.start(newest->time_ns, line.at(newest->time_ns), line.rate_rev_s());
  LineMoments narrow;
  collect(line, times_, block, kGate_rev, 0.0, narrow);
  line.correct(narrow);

  const double phase = line.at(oldest->time_ns);
  const double turns = could_foretell ? std::nearbyint(foretold - phase) : std::ceil(counted - phase);
  line.shift(turns);
  const bool continues = could_foretell && std::abs(phase + turns - foretold) < kContinues_rev;
  if (primed_ && !continues && phase + turns <= counted) line.shift(1.0);
  slow_ = line;
  fast_.follow(line);
  newest_ns_ = newest->time_ns;
  primed_ = true;
  return continues;
}

bool RotationTracker::add(const PacketAzimuths& packet) noexcept {
  if (packet.time_ns <= newest_ns_) return true;
  FadingLine line = slow_;
  line.advance(packet.time_ns);
  LineMoments seen;
  const int fitting = collect(line, times_, packet, kGate_rev, seen);
  if (fitting == 0) return false;

  rejected_ += static_cast<std::uint64_t>(times_.size - fitting);
  newest_ns_ = packet.time_ns;
  slow_ = line;
  fast_.advance(packet.time_ns);
  const LineMoments seen_by_fast = slow_.relative_to(fast_, seen);
  slow_.correct(seen);
  fast_.correct(seen_by_fast);
  // After a loss the short memory knows too little to be right against the long one.
  const double spacing_s = span_s(times_) / (times_.size - 1);
  const bool is_fast_certain = fast_.weight() > 0.5 * kShortMemory_s / spacing_s;
  const double apart = slow_.at(packet.time_ns) - fast_.at(packet.time_ns);
  if (is_fast_certain && std::abs(apart) > kReseed_rev) slow_.follow(fast_);
  return true;
}

}  // namespace pago::hdl64
