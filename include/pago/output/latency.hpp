// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "pago/core/histogram.hpp"
#include "pago/output/sweep_record.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

/// "ingest", "ground", ...
std::string_view stage_name(StageId stage) noexcept;

/// One stage's time on one sweep.
struct StageSplit {
  bool ran = false;
  std::int64_t wait_ns = 0;  ///< from the end of the stage before it; 0 for the first, and where they overlap
  std::int64_t run_ns = 0;   ///< wall time from its start to its end
  std::int64_t cpu_ns = 0;   ///< thread CPU time inside it
};
std::array<StageSplit, kNumStages> split_times(const SweepRecord& record) noexcept;

/// From the arrival of the sweep's last packet (in a replay: from the closing of the sweep) to the pose: when
/// odometry (first) and mapping (refined) were done. Below 0: there is none.
std::int64_t first_pose_ns(const SweepRecord& record) noexcept;
std::int64_t refined_pose_ns(const SweepRecord& record) noexcept;

/// What a table shows of a distribution; nanoseconds.
struct LatencySummary {
  std::uint64_t count = 0;
  std::int64_t p50_ns = 0, p90_ns = 0, p99_ns = 0, max_ns = 0;
};
LatencySummary summarize(const LatencyHistogram& histogram) noexcept;

/// Distributions over the sweeps of a run.
struct LatencyReport {
  struct Stage {
    LatencyHistogram wait, run, cpu;
  };
  std::array<Stage, kNumStages> stages;
  LatencyHistogram first_pose, refined_pose;

  void add(const SweepRecord& record) noexcept;
};

/// latency.csv: one row per sweep, milliseconds; empty cells where a stage did not run. Columns: sequence,
/// stamp_ns, STAGE_wait_ms, STAGE_run_ms, STAGE_cpu_ms for each stage, first_pose_ms, refined_pose_ms. [one
/// thread] not real-time.
class LatencyCsv {
 public:
  /// [set-up] Error when the file cannot be made.
  explicit LatencyCsv(const std::filesystem::path& file);

  void write(const SweepRecord& record) noexcept;
  void flush() noexcept { file_.flush(); }
  const std::string& complaint() const noexcept { return file_.complaint(); }

 private:
  TextFile file_;
};

}  // namespace pago::output
