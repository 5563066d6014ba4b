// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

/// Randomness as a function of what it is for: the same keys (seed, cell, purpose) give the same numbers on
/// every machine, in whatever order the world is built. [any thread] pure.
namespace pago::simulator {

/// Splitmix64's output function (Steele, Lea and Flood 2014): every input bit moves every output bit.
constexpr std::uint64_t scrambled(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

/// One number out of several keys; their order matters.
template <typename... Keys>
constexpr std::uint64_t hash(Keys... keys) noexcept {
  std::uint64_t h = 0;
  ((h = scrambled(h + kGolden + static_cast<std::uint64_t>(keys))), ...);
  return h;
}

/// [0, 1)
constexpr double unit_interval(std::uint64_t h) noexcept {
  return static_cast<double>(h >> 11U) * 0x1p-53;
}

/// The normal distribution's quantile, relative error below 1.2e-9 (P. J. Acklam, 2003). 0 < p < 1.
inline double normal_quantile(double p) noexcept {
  constexpr double kTail = 0.02425;
  const auto tail = [](double q) {
    return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q -
              2.549732539343734) *
                 q +
             4.374664141464968) *
                q +
            2.938163982698783) /
           ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q +
             3.754408661907416) *
                q +
            1.0);
  };
  if (p < kTail) return tail(std::sqrt(-2.0 * std::log(p)));
  if (p > 1.0 - kTail) return -tail(std::sqrt(-2.0 * std::log(1.0 - p)));
  const double q = p - 0.5, r = q * q;
  return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
            1.383577518672690e+02) *
               r -
           3.066479806614716e+01) *
              r +
          2.506628277459239) *
         q /
         (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
            6.680131188771972e+01) *
               r -
           1.328068155288572e+01) *
              r +
          1.0);
}

/// A stream of numbers that belongs to its keys.
class Random {
 public:
  Random() noexcept : state_(0) {}
  template <typename... Keys>
  explicit Random(Keys... keys) noexcept : state_(hash(keys...)) {}

  std::uint64_t bits() noexcept { return scrambled(state_ += kGolden); }
  double unit() noexcept { return unit_interval(bits()); }
  double between(double low, double high) noexcept { return low + (high - low) * unit(); }
  bool chance(double probability) noexcept { return unit() < probability; }
  /// Standard normal; half a step away from 0 and 1, where the quantile has no value.
  double normal() noexcept { return normal_quantile((static_cast<double>(bits() >> 12U) + 0.5) * 0x1p-52); }
  int below(int n) noexcept { return static_cast<int>(unit() * n); }

 private:
  std::uint64_t state_;
};

/// Smooth noise in the plane, in [-1, 1], with features of about `size_m`: random values on a lattice,
/// blended with a fifth-order polynomial, so that slopes are continuous.
inline double noise(std::uint64_t seed, double x, double y, double size_m) noexcept {
  const double u = x / size_m, v = y / size_m;
  const double i = std::floor(u), j = std::floor(v);
  const auto smooth = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
  const auto value = [&](int di, int dj) {
    return 2.0 * unit_interval(
                     hash(seed, static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj)) -
           1.0;
  };
  const double s = smooth(u - i), t = smooth(v - j);
  const double low = value(0, 0) + s * (value(1, 0) - value(0, 0));
  const double high = value(0, 1) + s * (value(1, 1) - value(0, 1));
  return low + t * (high - low);
}

/// 0 below `from`, 1 above `to`, smooth between.
inline double blend(double from, double to, double x) noexcept {
  const double t = std::fmin(1.0, std::fmax(0.0, (x - from) / (to - from)));
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace pago::simulator
