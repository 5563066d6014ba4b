// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pago/output/sweep_record.hpp"

namespace pago::output {

/// What a live run did because of the clock, and would not do again on its recording by itself. Told of
/// these, a replay gives the same bytes. Each list rises.
struct Decisions {
  std::vector<std::uint64_t> superseded;  ///< sweeps (by sequence) that were passed over for newer ones
  std::vector<std::uint64_t> unmet;   ///< which of the assembler's requests for an empty sweep, from 1, were
                                      ///< not met because none was free
  std::vector<std::uint64_t> resets;  ///< sweeps ahead of which odometry began anew

  std::string hash;  ///< of the live run's poses (see TrajectoryHash), to be found again; empty: not known

  bool empty() const noexcept { return superseded.empty() && unmet.empty() && resets.empty(); }
};

/// Collects them from what comes out of the pipeline. Keeps up to a million, years of a robot that is not
/// overloaded all the time. [publisher thread]
class DecisionLog {
 public:
  void add(const SweepRecord& record);
  /// At the end: how many requests for a sweep there were in all.
  void close(std::uint64_t requests);

  const Decisions& decisions() const noexcept { return decisions_; }
  /// False if there were too many to keep: such a run cannot be replayed as recorded.
  bool is_complete() const noexcept { return is_complete_; }

 private:
  void note(std::vector<std::uint64_t>& list, std::uint64_t number);
  void note_unmet_until(std::uint64_t request);

  Decisions decisions_;
  std::uint64_t last_met_ = 0;
  bool is_complete_ = true;
};

/// [set-up] Reads them from a run.json. Throws Error if it is none, or its log is incomplete.
Decisions read_decisions(const std::filesystem::path& run_json);

}  // namespace pago::output
