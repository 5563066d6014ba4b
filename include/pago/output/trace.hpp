// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pago/output/sweep_record.hpp"

namespace pago::output {

/// The thread that each stage runs on, by StageId, for the trace's rows.
using StageThreads = std::array<std::string_view, kNumStages>;
inline constexpr StageThreads kDefaultThreads{"ingest", "front", "front", "estimate", "estimate", "estimate"};

/// The stages of the last sweeps on a time axis, as a Chrome trace (open in Perfetto or chrome://tracing):
/// one row per thread, one bar per stage and sweep, monotonic clock. [one thread] not real-time.
class Trace {
 public:
  /// [set-up] `capacity` sweeps are kept; 0: none. `threads` are names that outlive the trace.
  explicit Trace(std::size_t capacity, StageThreads threads = kDefaultThreads);

  /// Takes the place of the oldest when full.
  void add(const SweepRecord& record);

  std::size_t size() const noexcept { return records_.size(); }
  std::string json() const;

 private:
  std::size_t capacity_, next_ = 0;
  StageThreads threads_;
  std::vector<SweepRecord> records_;
};

}  // namespace pago::output
