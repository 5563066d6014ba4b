// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pago::simulator {

/// How the head turns: at the set speed, which its motor keeps to a tenth of a percent. Starts at encoder
/// azimuth 180 degrees, behind the vehicle, where sweeps begin. With `stops_at_s` above 0 it stands still for
/// kStop_s from then on, and turns again at once.
class Head {
 public:
  explicit Head(double rotation_hz, double stops_at_s = 0.0)
      : rotation_hz_(rotation_hz), stops_at_s_(stops_at_s) {}

  /// Turns since encoder azimuth 0, clockwise.
  double revolutions(double t_s) const noexcept { return turned(turning_s(t_s)); }
  double rate_rev_s(double t_s) const noexcept { return is_standing(t_s) ? 0.0 : rate(turning_s(t_s)); }
  /// When the head has turned so far; Newton's method on an almost straight line.
  double time_at_s(double revolutions_wanted) const noexcept {
    double t_s = (revolutions_wanted - kStart_rev) / rotation_hz_;
    for (int i = 0; i < 4; ++i) t_s -= (turned(t_s) - revolutions_wanted) / rate(t_s);
    return stops_at_s_ > 0.0 && t_s > stops_at_s_ ? t_s + kStop_s : t_s;
  }
  /// What a packet says: whole encoder steps of 0.09 degrees passed, in hundredths of a degree.
  static std::uint16_t shown_cdeg(double revolutions) noexcept {
    constexpr double kSteps = 4000.0;
    const double fraction = revolutions - std::floor(revolutions);
    return static_cast<std::uint16_t>(9 * (static_cast<int>(fraction * kSteps) % static_cast<int>(kSteps)));
  }

  static constexpr double kStart_rev = 0.5, kStop_s = 2.0;

 private:
  static constexpr double kSwing = 0.001, kSlow_s = 3.0 / (2.0 * std::numbers::pi);

  bool is_standing(double t_s) const noexcept {
    return stops_at_s_ > 0.0 && t_s > stops_at_s_ && t_s < stops_at_s_ + kStop_s;
  }
  /// How long it has been turning.
  double turning_s(double t_s) const noexcept {
    if (stops_at_s_ <= 0.0 || t_s <= stops_at_s_) return t_s;
    return std::fmax(stops_at_s_, t_s - kStop_s);
  }
  double turned(double turning_s) const noexcept {
    return kStart_rev + rotation_hz_ * (turning_s + kSwing * kSlow_s * (1.0 - std::cos(turning_s / kSlow_s)));
  }
  double rate(double turning_s) const noexcept {
    return rotation_hz_ * (1.0 + kSwing * std::sin(turning_s / kSlow_s));
  }

  double rotation_hz_, stops_at_s_;
};

}  // namespace pago::simulator
