// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pago/report/run.hpp"

namespace pago::report {

/// Durations of one kind over the sweeps of a run, in their order.
struct LatencySeries {
  std::string name;     ///< "ground", ..., "first pose", "refined pose", "all stages"
  bool is_cpu = false;  ///< thread CPU time; else wall time
  std::vector<double> ms;
  std::vector<double> sweeps;  ///< their numbers
};

/// Thread CPU time of all stages on a sweep.
std::int64_t cpu_of_all_ns(const output::LatencyRow& row) noexcept;

/// CPU time of each stage that ran and of all together, and the wall time from the last packet to the poses.
std::vector<LatencySeries> latency_series(const std::vector<output::LatencyRow>& rows);

/// Nearest rank, exact. NaN without values.
struct Percentiles {
  std::size_t count = 0;
  double p50 = 0.0, p90 = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;
};
Percentiles percentiles_of(std::vector<double> values);

/// Time to the poses and CPU per stage. Empty where no run has latencies.
std::string latency_section(const std::vector<TimedRun>& runs);

}  // namespace pago::report
