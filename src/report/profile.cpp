// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pago/core/units.hpp"

namespace pago::report {
namespace {

using output::LatencyRow;
using output::StageSplit;

ProfileRow stage_row(const output::RunFiles& run,
                     std::size_t stage,
                     TimeKind kind,
                     std::int64_t StageSplit::*duration_ns) {
  const std::string name(output::stage_name(static_cast<StageId>(stage)));
  ProfileRow row{name, kind, {name, kind == TimeKind::kCpu, {}, {}}};
  for (const LatencyRow& sweep : run.latency) {
    if (!sweep.stages[stage].ran) continue;
    row.series.ms.push_back(milliseconds(sweep.stages[stage].*duration_ns));
    row.series.sweeps.push_back(static_cast<double>(sweep.sequence));
  }
  return row;
}

/// Pairs of the two series' values for the same sweeps, whose numbers ascend in both.
template <typename Visit>
void for_each_pair(const LatencySeries& a, const LatencySeries& b, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < a.sweeps.size() && j < b.sweeps.size();) {
    if (a.sweeps[i] < b.sweeps[j]) {
      ++i;
    } else if (b.sweeps[j] < a.sweeps[i]) {
      ++j;
    } else {
      visit(a.ms[i++], b.ms[j++]);
    }
  }
}

ProfileChange change_of(const ProfileRow& before, const ProfileRow& after) {
  ProfileChange change{before.name, before.kind, percentiles_of(before.series.ms),
                       percentiles_of(after.series.ms)};
  double slower = 0.0;
  for_each_pair(before.series, after.series, [&](double a_ms, double b_ms) {
    ++change.num_pairs;
    slower += b_ms > a_ms ? 1.0 : b_ms < a_ms ? 0.0 : 0.5;
  });
  change.slower_share = change.num_pairs == 0 ? std::numeric_limits<double>::quiet_NaN()
                                              : slower / static_cast<double>(change.num_pairs);
  return change;
}

}  // namespace

std::string_view to_string(TimeKind kind) noexcept {
  constexpr std::array<std::string_view, 4> kNames{"wait", "run", "cpu", "wall"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<ProfileRow> profile_rows(const output::RunFiles& run) {
  std::vector<ProfileRow> rows;
  const auto add = [&](ProfileRow row) {
    if (!row.series.ms.empty()) rows.push_back(std::move(row));
  };
  for (std::size_t stage = 0; stage < kNumStages; ++stage) {
    if (run.facts.is_live) add(stage_row(run, stage, TimeKind::kWait, &StageSplit::wait_ns));
    add(stage_row(run, stage, TimeKind::kRun, &StageSplit::run_ns));
    add(stage_row(run, stage, TimeKind::kCpu, &StageSplit::cpu_ns));
  }
  for (LatencySeries& series : latency_series(run.latency)) {
    if (series.name == "all stages")
      add({series.name, TimeKind::kCpu, std::move(series)});
    else if (!series.is_cpu && run.facts.is_live)
      add({series.name, TimeKind::kPose, std::move(series)});
  }
  return rows;
}

DeadlineMisses deadline_misses(const output::RunFiles& run, double deadline_ms) {
  DeadlineMisses misses;
  if (!run.facts.is_live) return misses;
  for (const LatencyRow& row : run.latency) {
    if (row.first_pose_ns < 0) continue;
    ++misses.of;
    const bool is_late = row.refined_pose_ns < 0 || milliseconds(row.refined_pose_ns) > deadline_ms;
    misses.late += is_late ? 1U : 0U;
  }
  return misses;
}

bool ProfileChange::is_significant() const noexcept {
  constexpr double kOnceInAThousand_sigmas = 3.29;
  const double sigma = 0.5 / std::sqrt(static_cast<double>(num_pairs));
  return std::abs(slower_share - 0.5) > kOnceInAThousand_sigmas * sigma;
}

std::vector<ProfileChange> profile_changes(const output::RunFiles& before, const output::RunFiles& after) {
  std::vector<ProfileChange> changes;
  const std::vector<ProfileRow> others = profile_rows(after);
  for (const ProfileRow& row : profile_rows(before)) {
    const auto same = std::find_if(others.begin(), others.end(), [&](const ProfileRow& other) {
      return other.name == row.name && other.kind == row.kind;
    });
    if (same != others.end()) changes.push_back(change_of(row, *same));
  }
  return changes;
}

}  // namespace pago::report
