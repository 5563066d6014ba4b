// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "pago/output/latency.hpp"
#include "pago/output/pose_csv.hpp"

/// What a run has left in its results folder, read back: for reports and comparisons. [set-up] all of it
/// allocates; throws Error for files that are not what their name says. Trajectories:
/// evaluation/trajectory.hpp.
namespace pago::output {

/// A row of latency.csv.
struct LatencyRow {
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
  std::array<StageSplit, kNumStages> stages;
  std::int64_t first_pose_ns = -1, refined_pose_ns = -1;  ///< below 0: there is none
};
/// Columns of unknown stages are passed over, missing ones count as not run.
std::vector<LatencyRow> read_latency_csv(const std::filesystem::path& file);

/// What run.json says, as far as reports show it. Names that the file does not have stay empty or zero.
struct RunFacts {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::string version, source, complaint, hash, config_toml;
  std::vector<std::pair<std::string, std::string>> facts;
  bool is_live = false;  ///< sweeps came at the sensor's pace, so that wall time means something
  double wall_s = 0.0, length_m = 0.0;
  std::uint64_t poses = 0;
  Counts sweeps;   ///< "posed", "partial", and "dropped: CAUSE" for each cause
  Counts packets;  ///< "received", "decoded", ...; empty when the source had none
  Counts firings;  ///< "expected", "decoded", "lost"
  Counts health;   ///< "OK", ...: poses
  std::uint64_t dropped_sweeps() const noexcept;
};
RunFacts read_run_json(const std::filesystem::path& file);

/// All of it. A file that is not there leaves its part empty.
struct RunFiles {
  std::filesystem::path folder;
  RunFacts facts;
  std::vector<LatencyRow> latency;
  std::vector<PoseFacts> poses;
};
/// Error when the folder has neither run.json nor latency.csv: it is no results folder.
RunFiles read_run_files(const std::filesystem::path& folder);

/// Whether a folder looks like one.
bool is_results_folder(const std::filesystem::path& folder);

}  // namespace pago::output
