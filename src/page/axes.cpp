// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "axes.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/text.hpp"

namespace pago::page {
namespace {

/// The round number nearest to a step, in ratio.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  const double digit = step / power;
  if (digit < 1.5) return power;
  if (digit < 3.5) return 2.0 * power;
  return digit < 7.5 ? 5.0 * power : 10.0 * power;
}

int decimals_of(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
}

std::string tick_text(double value, int decimals) {
  const double clean = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
  const bool is_short = std::abs(value) < 1e6 && decimals <= 5;
  return is_short ? format("%.*f", decimals, clean) : format("%.3g", clean);
}

std::vector<Tick> log_ticks(const Scale& scale, int wanted) {
  std::vector<Tick> ticks;
  const double decades = std::log10(scale.to / scale.from);
  const std::vector<double> digits = decades * 3.0 <= wanted ? std::vector{1.0, 2.0, 5.0} : std::vector{1.0};
  for (double power = std::pow(10.0, std::floor(std::log10(scale.from))); power <= scale.to; power *= 10.0)
    for (const double digit : digits) {
      const double value = digit * power;
      if (value >= scale.from * (1 - 1e-9) && value <= scale.to * (1 + 1e-9))
        ticks.push_back({value, tick_text(value, decimals_of(value))});
    }
  return ticks;
}

}  // namespace

bool Scale::shows(double value) const noexcept {
  return std::isfinite(value) && (!is_log || value > 0.0);
}

double Scale::operator()(double value) const noexcept {
  const double part = is_log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return start_px + part * (end_px - start_px);
}

std::pair<double, double> range_of(const std::vector<const std::vector<double>*>& lists, bool is_log) {
  const Scale scale{.is_log = is_log};
  double min = HUGE_VAL, max = -HUGE_VAL;
  for (const std::vector<double>* list : lists)
    for (const double value : *list)
      if (scale.shows(value)) {
        min = std::min(min, value);
        max = std::max(max, value);
      }
  return min <= max ? std::pair{min, max} : std::pair{is_log ? 0.1 : 0.0, 1.0};
}

Scale scale_for(const Axis& axis, double min, double max, double start_px, double end_px) {
  constexpr int kIntervals = 5;
  Scale scale{.from = min, .to = max, .start_px = start_px, .end_px = end_px, .is_log = axis.is_log};
  if (axis.is_log) {
    if (max < 1.5 * min) scale = {min / 1.5, max * 1.5, start_px, end_px, true};
  } else {
    if (max - min < 1e-9 * std::max(std::abs(min), std::abs(max)) || max == min) {
      const double margin = max == 0.0 ? 1.0 : 0.1 * std::abs(max);
      min -= margin;
      max += margin;
    }
    const double step = round_step((max - min) / kIntervals) / 2.0;
    scale.from = step * std::floor(min / step + 1e-9);
    scale.to = step * std::ceil(max / step - 1e-9);
  }
  return scale;
}

std::vector<Tick> ticks_of(const Scale& scale, int wanted) {
  if (scale.is_log) return log_ticks(scale, 3 * wanted);
  const double step = round_step((scale.to - scale.from) / wanted);
  const int decimals = decimals_of(step);
  std::vector<Tick> ticks;
  for (double k = std::ceil(scale.from / step - 1e-9); k * step <= scale.to + 1e-9 * step; k += 1.0)
    ticks.push_back({k * step, tick_text(k * step, decimals)});
  return ticks;
}

}  // namespace pago::page
