// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/clock_offset.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/units.hpp"

namespace pago::hdl64 {

namespace {

/// A frame of 1,248 bytes on the sensor's 100 Mbit/s line: the least delay there can be.
constexpr std::int64_t kTransmission_ns = 100'000;
constexpr double kStep_s = 0.05;
/// Packets that come too early: 900 of them are a quarter of a second.
constexpr int kTooEarly = 900;
constexpr int kLateSeconds = 3;
constexpr double kFastestSlew = 1e-3;
/// An offset is followed within about so long.
constexpr double kFollow_s = 8.0;
/// Before so many seconds have passed a slope would be jitter, and the offset needs no smoothing.
constexpr std::size_t kSteady = 8;

}  // namespace

void ClockOffset::add(std::int64_t sensor_ns, std::int64_t arrival_ns) noexcept {
  const std::int64_t offset_ns = arrival_ns - sensor_ns - kTransmission_ns;
  if (!started_) begin(sensor_ns, offset_ns);
  const Point point{seconds(sensor_ns - origin_ns_), seconds(offset_ns - origin_offset_ns_)};
  if (has_stepped(point)) {
    const std::uint64_t steps = steps_ + 1;
    begin(sensor_ns, offset_ns);
    steps_ = steps;
    return;
  }
  if (too_early_ > 0) return;
  if (point.t_s - second_began_s_ >= 1.0) {
    end_second();
    least_ = point;
    second_began_s_ = point.t_s;
  }
  if (point.offset_s < least_.offset_s) least_ = point;
  // At first every better packet counts at once.
  if (num_seconds_ < kSteady && point.offset_s < line_at(point.t_s)) {
    line_s_ = out_s_ = point.offset_s;
    line_t_s_ = out_t_s_ = point.t_s;
  }
}

void ClockOffset::begin(std::int64_t sensor_ns, std::int64_t offset_ns) noexcept {
  *this = {};
  started_ = true;
  origin_ns_ = sensor_ns;
  origin_offset_ns_ = offset_ns;
}

/// Tells a step of the host's clock from jitter.
bool ClockOffset::has_stepped(const Point& point) noexcept {
  too_early_ = point.offset_s < line_at(point.t_s) - kStep_s ? too_early_ + 1 : 0;
  return too_early_ >= kTooEarly || late_seconds_ >= kLateSeconds;
}

void ClockOffset::end_second() noexcept {
  const bool is_late = least_.offset_s > line_at(least_.t_s) + kStep_s;
  late_seconds_ = is_late ? late_seconds_ + 1 : 0;
  if (is_late) return;  // a stall, or the first sign of a step
  seconds_[num_seconds_++ % kSeconds] = least_;
  fit();
  const double now_s = least_.t_s;
  out_s_ += out_slope_ * (now_s - out_t_s_);
  out_t_s_ = now_s;
  if (num_seconds_ <= kSteady) out_s_ = line_at(now_s);
  const double behind_s = line_at(now_s) - out_s_;
  out_slope_ = slope_ + std::clamp(behind_s / kFollow_s, -kFastestSlew, kFastestSlew);
}

// The lower hull of the seconds' points; the edge under their middle is the line.
void ClockOffset::fit() noexcept {
  const std::size_t n = std::min(num_seconds_, kSeconds);
  const std::size_t first = num_seconds_ - n;
  std::array<Point, kSeconds> hull;  // NOLINT(*-member-init): the first `size` are set
  std::size_t size = 0;
  double middle_s = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point& p = seconds_[(first + i) % kSeconds];
    middle_s += p.t_s / static_cast<double>(n);
    while (size >= 2) {
      const Point &a = hull[size - 2], &b = hull[size - 1];
      if ((b.offset_s - a.offset_s) * (p.t_s - a.t_s) < (p.offset_s - a.offset_s) * (b.t_s - a.t_s)) break;
      --size;
    }
    hull[size++] = p;
  }
  std::size_t edge = 1;
  while (edge + 1 < size && hull[edge].t_s < middle_s) ++edge;
  if (size < 2 || n < kSteady) {
    const auto* const least =
        std::min_element(hull.data(), hull.data() + size,
                         [](const auto& a, const auto& b) { return a.offset_s < b.offset_s; });
    line_t_s_ = least->t_s;
    line_s_ = least->offset_s;
    slope_ = 0.0;
    return;
  }
  const Point &a = hull[edge - 1], &b = hull[edge];
  slope_ = (b.offset_s - a.offset_s) / (b.t_s - a.t_s);
  line_t_s_ = b.t_s;
  line_s_ = b.offset_s;
}

std::int64_t ClockOffset::at(std::int64_t sensor_ns) const noexcept {
  if (!started_) return 0;
  const double offset_s = out_s_ + out_slope_ * (seconds(sensor_ns - origin_ns_) - out_t_s_);
  return origin_offset_ns_ + std::llround(1e9 * offset_s);
}

}  // namespace pago::hdl64
