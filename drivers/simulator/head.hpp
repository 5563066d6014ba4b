// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pago::simulator {

/// How the head turns: at the set speed, which its motor keeps to a tenth of a percent. Starts at encoder
/// azimuth 180 degrees, behind the vehicle, where sweeps begin.
class Head {
 public:
  explicit Head(double rotation_hz) : rotation_hz_(rotation_hz) {}

  /// Turns since encoder azimuth 0, clockwise.
  double revolutions(double t_s) const noexcept {
    return kStart_rev + rotation_hz_ * (t_s + kSwing * kSlow_s * (1.0 - std::cos(t_s / kSlow_s)));
  }
  double rate_rev_s(double t_s) const noexcept {
    return rotation_hz_ * (1.0 + kSwing * std::sin(t_s / kSlow_s));
  }
  /// When the head has turned so far; Newton's method on an almost straight line.
  double time_at_s(double revolutions_wanted) const noexcept {
    double t_s = (revolutions_wanted - kStart_rev) / rotation_hz_;
    for (int i = 0; i < 4; ++i) t_s -= (revolutions(t_s) - revolutions_wanted) / rate_rev_s(t_s);
    return t_s;
  }
  /// What a packet says: whole encoder steps of 0.09 degrees passed, in hundredths of a degree.
  static std::uint16_t shown_cdeg(double revolutions) noexcept {
    constexpr double kSteps = 4000.0;
    const double fraction = revolutions - std::floor(revolutions);
    return static_cast<std::uint16_t>(9 * (static_cast<int>(fraction * kSteps) % static_cast<int>(kSteps)));
  }

  static constexpr double kStart_rev = 0.5;

 private:
  static constexpr double kSwing = 0.001, kSlow_s = 3.0 / (2.0 * std::numbers::pi);
  double rotation_hz_;
};

}  // namespace pago::simulator
