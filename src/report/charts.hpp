// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pago/page/chart.hpp"
#include "pago/report/run.hpp"

namespace pago::report {

inline constexpr double kDegPerRad = 57.295779513082320876798154814105;

/// A line per run over the distance along the truth.
page::Chart over_distance(const std::vector<ScoredRun>& runs,
                          const std::string& title,
                          const std::string& unit_label,
                          const std::function<double(const evaluation::CoursePoint&)>& value);

/// In kilometres where the path is long.
double distance_scale(const std::vector<ScoredRun>& runs);
std::string distance_label(const std::vector<ScoredRun>& runs);

}  // namespace pago::report
