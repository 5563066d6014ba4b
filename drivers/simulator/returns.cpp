// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "returns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials.hpp"

namespace pago::simulator {
namespace {

/// Half of the returns are lost where reflectivity x cos / range^2 is this: asphalt from 1.7 m above at 50 m.
constexpr double kThreshold = 2.2e-6;
/// A pulse of some 5 ns: echoes that are closer together are one.
constexpr double kPulse_m = 0.7;
double brightness(const Echo& echo, const ReturnModel& model) noexcept {
  const Optics& material = optics(echo.surface.material);
  // What mirrors, returns light only when hit square on.
  const double square_on = echo.cos_incidence * echo.cos_incidence * echo.cos_incidence * echo.cos_incidence;
  double part = 1.0 - material.shine * (1.0 - square_on);
  if (echo.surface.material == Material::kAsphalt)
    part *= 1.0 - 0.99 * model.wetness;  // what is left mirrors away
  return reflectivity(echo.surface) * part * echo.share;
}

double strength(const Echo& echo, const ReturnModel& model) noexcept {
  return brightness(echo, model) * echo.cos_incidence / (echo.range_m * echo.range_m);
}

bool is_detected(double strength, double always_lost, Random& random) noexcept {
  const double ratio = strength / kThreshold;
  const double chance = ratio * std::sqrt(ratio) / (1.0 + ratio * std::sqrt(ratio));
  return random.unit() < chance * (1.0 - always_lost);
}

Return measured(const Echo& echo,
                const ReturnModel& model,
                const LaserOptics& laser,
                Random& random) noexcept {
  const double inverse_cos = 1.0 / std::max(kLeastCosIncidence, echo.cos_incidence);
  // Even at 85 degrees KITTI's unit is hardly noisier than square on.
  const double noise_m = model.range_noise_m * (0.97 + 0.03 * inverse_cos) * random.normal();
  // Blades of grass stop a beam before it comes to the soil.
  constexpr double kMostlyStopped_m = 0.5;
  const double pile_m = optics(echo.surface.material).pile_m;
  const double early_m =
      pile_m > 0.0 ? std::min(kMostlyStopped_m, -pile_m * std::log(1.0 - random.unit()) * inverse_cos) : 0.0;
  Return result{.range_m = echo.range_m - early_m + noise_m, .label = echo.surface.label};
  // The unit levels intensities, by distance up to about 25 m and by incidence: asphalt has about 70
  // from 5 to 25 m, walls 100, and beyond 50 m there is little but 0 (KITTI, first scans of sequence 00).
  const double far = echo.range_m / 36.0, dimmed = 1.0 + far * far * far * far;
  const double root = std::sqrt(brightness(echo, model));
  const double level = 138.0 * std::sqrt(root * std::sqrt(root)) / dimmed * laser.gain;
  result.intensity = std::clamp(level * (1.0 + 0.08 * random.normal()) + 2.0 * random.normal(), 0.0, 255.0);
  result.is_there = is_detected(strength(echo, model), laser.always_lost, random);
  return result;
}

/// A drop of rain near the sensor.
Return drop_of_rain(Random& random) noexcept {
  return {.range_m = 1.0 + 14.0 * random.unit() * random.unit(),
          .intensity = random.between(0.0, 25.0),
          .label = Label::kOutlier,
          .is_there = true};
}

Echo merged(const Echo& a, const Echo& b, double weight_a, double weight_b) noexcept {
  Echo result = weight_a >= weight_b ? a : b;
  result.range_m = (weight_a * a.range_m + weight_b * b.range_m) / (weight_a + weight_b);
  result.share = 1.0;
  return result;
}

}  // namespace

Returns returns_of(const ReturnModel& model,
                   const std::array<Echo, 2>& echoes,
                   std::size_t num_echoes,
                   const LaserOptics& laser,
                   Random& random) noexcept {
  if (model.outliers > 0.0 && random.chance(model.outliers)) return {drop_of_rain(random), {}};
  if (num_echoes == 0) return {};
  if (num_echoes == 1) return {measured(echoes[0], model, laser, random), {}};
  const double first = strength(echoes[0], model), second = strength(echoes[1], model);
  if (std::abs(echoes[0].range_m - echoes[1].range_m) < kPulse_m)
    return {measured(merged(echoes[0], echoes[1], first, second), model, laser, random), {}};
  Returns both{measured(echoes[0], model, laser, random), measured(echoes[1], model, laser, random)};
  const bool is_second_stronger = second > first;
  if (is_second_stronger) std::swap(both[0], both[1]);
  if (!both[0].is_there) both[0] = std::exchange(both[1], Return{});
  return both;
}

}  // namespace pago::simulator
