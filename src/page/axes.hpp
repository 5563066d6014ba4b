// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pago/page/chart.hpp"

namespace pago::page {

struct Tick {
  double value = 0.0;
  std::string text;
};

/// From values to places on the picture.
struct Scale {
  double from = 0.0, to = 1.0;          ///< values
  double start_px = 0.0, end_px = 1.0;  ///< places
  bool is_log = false;

  bool shows(double value) const noexcept;  ///< finite, and positive where it must be
  double operator()(double value) const noexcept;
};

/// The range that the data need, widened to whole ticks.
Scale scale_for(const Axis& axis, double min, double max, double start_px, double end_px);

/// About `wanted` round values (1, 2, 5 times a power of ten) inside the scale.
std::vector<Tick> ticks_of(const Scale& scale, int wanted);

/// Least and greatest of the values that can be shown; {0, 1} if none can.
std::pair<double, double> range_of(const std::vector<const std::vector<double>*>& lists, bool is_log);

}  // namespace pago::page
