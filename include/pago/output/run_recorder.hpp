// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pago/config/output.hpp"
#include "pago/output/decisions.hpp"
#include "pago/output/latency.hpp"
#include "pago/output/map_writer.hpp"
#include "pago/output/pose_csv.hpp"
#include "pago/output/run_report.hpp"
#include "pago/output/trace.hpp"
#include "pago/output/trajectory_writer.hpp"

namespace pago::output {

/// The files of one run, written as it goes on:
///   odometry.tum, .kitti     first poses, one per sweep that has a pose
///   trajectory.tum, .kitti   refined poses, the same sweeps
///   poses.csv                health and covariance, the same sweeps
///   front_end.tum, .kitti    products of scan-to-scan increments alone, the same sweeps: for studies
///   latency.csv              every sweep
///   trace.json, run.json     at the end
///   map.ply                  at the end, of the keyframes; a map that a reset ended is map_until_N.ply
/// [publisher thread] all of it; blocks on the disk. A full disk never ends a run: see complaints().
class RunRecorder {
 public:
  /// [set-up] Makes the files in an existing folder (results_folder.hpp); Error when that cannot be done.
  RunRecorder(const std::filesystem::path& folder,
              const OutputConfig& config,
              StageThreads threads = kDefaultThreads);

  void add(const SweepRecord& record);
  /// A keyframe, for the map; before the record of its sweep.
  void add(const MapSweep& sweep);

  /// Hands everything so far to the operating system; add() does so at the configured interval.
  void flush() noexcept;

  /// Writes run.json, trace.json and map.ply, and flushes the rest. May be called again with a newer report.
  void finish(const RunReport& report);

  /// Writes the last sweeps' stages to trace_N.json, N being the newest sweep; returns the file, or nothing
  /// if there is no trace or it cannot be written (see complaints()).
  std::string save_trace();

  /// One sentence per file that is incomplete; certain after flush() or finish().
  std::vector<std::string> complaints() const;

  const RunTotals& totals() const noexcept { return totals_; }
  const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  using Clock = std::chrono::steady_clock;

  void write_at_end(const char* name, const std::string& text);
  void write_map(const std::string& name);

  std::filesystem::path folder_;
  Clock::duration flush_interval_;
  Clock::time_point next_flush_;
  TrajectoryWriter front_end_, first_, refined_;
  PoseCsv poses_;
  LatencyCsv latency_;
  Trace trace_;
  std::optional<MapWriter> map_;
  DecisionLog decisions_;
  std::uint64_t newest_sequence_ = 0;
  RunTotals totals_;
  std::vector<std::string> end_complaints_;
};

}  // namespace pago::output
