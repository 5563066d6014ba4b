// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "pago/report/latency.hpp"

namespace pago::report {
namespace {

using output::LatencyRow;
using output::StageSplit;

constexpr double kMsPerNs = 1e-6;

/// Value of a row in nanoseconds; below 0 there is none.
using OfRow = std::function<std::int64_t(const LatencyRow&)>;

void add(std::vector<LatencySeries>& all,
         const std::vector<LatencyRow>& rows,
         const std::string& name,
         bool is_cpu,
         const OfRow& value) {
  LatencySeries series{name, is_cpu, {}, {}};
  for (const LatencyRow& row : rows) {
    const std::int64_t ns = value(row);
    if (ns < 0) continue;
    series.ms.push_back(static_cast<double>(ns) * kMsPerNs);
    series.sweeps.push_back(static_cast<double>(row.sequence));
  }
  if (!series.ms.empty()) all.push_back(std::move(series));
}

}  // namespace

std::int64_t cpu_of_all_ns(const LatencyRow& row) noexcept {
  std::int64_t sum_ns = 0;
  for (const StageSplit& split : row.stages) sum_ns += split.cpu_ns;
  return sum_ns;
}

std::vector<LatencySeries> latency_series(const std::vector<LatencyRow>& rows) {
  std::vector<LatencySeries> all;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const std::string name(output::stage_name(static_cast<StageId>(i)));
    add(all, rows, name, true,
        [i](const LatencyRow& r) { return r.stages[i].ran ? r.stages[i].cpu_ns : -1; });
  }
  add(all, rows, "all stages", true,
      [](const LatencyRow& r) { return r.first_pose_ns < 0 ? -1 : cpu_of_all_ns(r); });
  add(all, rows, "first pose", false, [](const LatencyRow& r) { return r.first_pose_ns; });
  add(all, rows, "refined pose", false, [](const LatencyRow& r) { return r.refined_pose_ns; });
  return all;
}

Percentiles percentiles_of(std::vector<double> values) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {0, kNaN, kNaN, kNaN, kNaN, kNaN};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double percent) {
    const double position = std::ceil(percent / 100.0 * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(1.0, position)) - 1];
  };
  return {values.size(), rank(50), rank(90), rank(99), rank(99.9), values.back()};
}

}  // namespace pago::report
