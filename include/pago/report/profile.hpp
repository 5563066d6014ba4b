// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pago/report/latency.hpp"

/// Where a run's time went, and where another one's did: what `pago profile` shows. [set-up] everything here
/// allocates.
namespace pago::report {

enum class TimeKind {
  kWait,  ///< from the end of the stage before it
  kRun,   ///< wall time inside it
  kCpu,   ///< thread CPU time inside it
  kPose,  ///< wall time from the sweep's last packet to a pose
};
/// "wait", "run", "cpu", "wall".
std::string_view to_string(TimeKind kind) noexcept;

/// One duration of each sweep that has it.
struct ProfileRow {
  std::string name;  ///< "ground", ..., "all stages", "first pose", "refined pose"
  TimeKind kind = TimeKind::kCpu;
  LatencySeries series;
};
/// Each stage that ran: wait, run, CPU; the CPU time of all stages; and of a live run the time to the poses.
/// In a replay sweeps are read ahead and wait for each other, so that waits and times to poses would say
/// nothing: it has none.
std::vector<ProfileRow> profile_rows(const output::RunFiles& run);

/// Sweeps of a live run whose refined pose came later than this after their last packet, or not at all.
/// Sweeps without a first pose, partial and dropped ones, have no deadline: they are counted elsewhere.
struct DeadlineMisses {
  std::size_t late = 0, of = 0;
};
DeadlineMisses deadline_misses(const output::RunFiles& run, double deadline_ms);

/// How a duration of two runs compares.
struct ProfileChange {
  std::string name;
  TimeKind kind = TimeKind::kCpu;
  Percentiles before, after;
  /// Of the sweeps that both runs have, by number: part of those that took longer in the second run. 0.5:
  /// chance. NaN if there are none.
  double slower_share = 0.0;
  std::size_t num_pairs = 0;
  double p50_ratio() const noexcept { return after.p50 / before.p50; }
  double p99_ratio() const noexcept { return after.p99 / before.p99; }
  /// A sign test: more sweeps took longer, or fewer, than chance would have it once in a thousand times. It
  /// sees what differs between the two runs; not whether the program or the machine's load was the reason.
  bool is_significant() const noexcept;
};
/// Durations that both have, in the order of the first.
std::vector<ProfileChange> profile_changes(const output::RunFiles& before, const output::RunFiles& after);

/// For the terminal.
std::string profile_text(const TimedRun& run, double deadline_ms);
std::string profile_comparison_text(const TimedRun& before, const TimedRun& after, double deadline_ms);

/// The same as a page with figures; one or two runs, the second compared with the first.
struct ProfilePage {
  std::vector<TimedRun> runs;
  double deadline_ms = 100.0;
  std::string made_by;
};
std::string profile_page(const ProfilePage& page);

}  // namespace pago::report
