// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pago/core/counters.hpp"
#include "pago/core/sources.hpp"
#include "pago/output/decisions.hpp"
#include "pago/output/latency.hpp"
#include "pago/output/trajectory_hash.hpp"

namespace pago::output {

/// What adds up over the sweeps of a run. About 150 kB of histograms: keep it off small stacks. [one thread]
/// add() is real-time safe.
struct RunTotals {
  std::uint64_t num_poses = 0;
  std::uint64_t partial = 0, superseded = 0;  ///< sweeps without a pose, by fate
  double length_m = 0.0;  ///< of the refined poses' path; the way back to a reset's new origin is none
  std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;
  std::array<std::uint64_t, 4> health{};                ///< poses by Health
  std::uint64_t num_keyframes = 0, num_map_points = 0;  ///< in the saved map
  TrajectoryHash hash;                                  ///< over each pose's `first` and `refined` numbers
  LatencyReport latency;

  /// Sweeps without a pose count for latency only.
  void add(const SweepRecord& record) noexcept;

 private:
  Eigen::Vector3d last_position_m_ = Eigen::Vector3d::Zero();
  bool begins_anew_ = false;
};

/// What the parts of the program know about a run when it ends. Empty counters: the source has no such thing
/// (a KITTI folder has no packets).
struct RunReport {
  std::string version;      ///< of the program
  std::string source;       ///< as the user named it
  std::string config_toml;  ///< the complete settings of the run
  std::vector<std::pair<std::string, std::string>>
      facts;  ///< e.g. {"sensor", "HDL-64E S2"}, {"pose at", "end"}; names may repeat
  std::optional<SourceCounters> source_counters;
  std::optional<PacketCounters> packets;
  std::optional<FiringCounters> firings;
  SweepCounters sweeps;
  std::optional<std::uint64_t> requests;  ///< of the assembler for an empty sweep, when the run is over
  std::uint64_t self_hits = 0;            ///< returns on the vehicle's own body, left out
  std::uint64_t unrecorded = 0;           ///< live: sweeps and poses that are missing in the files
  std::uint64_t unmapped = 0;             ///< live: keyframes that are missing in the map
  bool is_live = false;                   ///< a replay's waits say nothing: it reads ahead as far as it can
  double wall_s = 0.0;                    ///< how long the run took
  std::string complaint;                  ///< empty, or why the run ended before its source did
};

/// run.json: everything above as one object; durations in ms.
std::string run_json(const RunReport& report, const RunTotals& totals, const DecisionLog& decisions = {});

/// A few lines for the terminal: sweeps, drops, length, latency per stage, where the files are.
std::string run_summary(const RunReport& report,
                        const RunTotals& totals,
                        const std::filesystem::path& folder);

}  // namespace pago::output
