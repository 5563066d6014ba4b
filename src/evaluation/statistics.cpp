// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "no_value.hpp"

namespace pago::evaluation {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// x^a exp(-x) / Gamma(a), the factor before both expansions.
double gamma_factor(double a, double x) {
  return std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// The regularised incomplete gamma function P(a, x) by its power series, which converges fast below x = a
/// (Abramowitz and Stegun 6.5.29).
double gamma_p_series(double a, double x) {
  double term = 1.0 / a, sum = term;
  for (double n = a + 1.0; term > kEpsilon * sum; n += 1.0) sum += term *= x / n;
  return sum * gamma_factor(a, x);
}

/// 1 - P(a, x) by its continued fraction, which converges fast above x = a (6.5.31 there; evaluated from the
/// front by the method of Lentz).
double gamma_q_fraction(double a, double x) {
  constexpr double kTiny = std::numeric_limits<double>::min() / kEpsilon;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, fraction = d;
  for (double n = 1.0, factor = 0.0; std::abs(factor - 1.0) > kEpsilon; n += 1.0) {
    const double numerator = n * (a - n);
    b += 2.0;
    d = numerator * d + b;
    c = b + numerator / c;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    if (std::abs(c) < kTiny) c = kTiny;
    fraction *= factor = c * d;
  }
  return fraction * gamma_factor(a, x);
}

double chi_square_cdf(double x, double degrees_of_freedom) {
  if (x <= 0.0) return 0.0;
  const double a = 0.5 * degrees_of_freedom, half = 0.5 * x;
  return half < a + 1.0 ? gamma_p_series(a, half) : 1.0 - gamma_q_fraction(a, half);
}

}  // namespace

Statistics statistics_of(std::vector<double> values) {
  if (values.empty()) return {0, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue, kNoValue};
  Statistics s;
  s.count = values.size();
  const double n = static_cast<double>(s.count);
  double sum = 0.0, sum_sq = 0.0, sum_deviation_sq = 0.0;
  for (const double value : values) {
    sum += value;
    sum_sq += value * value;
  }
  s.mean = sum / n;
  s.rmse = std::sqrt(sum_sq / n);
  for (const double value : values) sum_deviation_sq += (value - s.mean) * (value - s.mean);
  s.deviation = std::sqrt(sum_deviation_sq / n);
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  s.min = *min;
  s.max = *max;
  s.median = median_of(values);
  return s;
}

double chi_square_quantile(double p, double degrees_of_freedom) {
  double low = 0.0, high = degrees_of_freedom;
  while (chi_square_cdf(high, degrees_of_freedom) < p) high *= 2.0;
  while (high - low > 1e-11 * high) {
    const double middle = 0.5 * (low + high);
    (chi_square_cdf(middle, degrees_of_freedom) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace pago::evaluation
