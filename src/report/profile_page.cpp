// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "pago/page/chart.hpp"
#include "pago/page/html.hpp"
#include "pago/report/profile.hpp"

namespace pago::report {
namespace {

using page::number;

std::string name_of(const std::string& name, TimeKind kind) {
  return name + ", " + std::string(to_string(kind));
}

std::string run_table(const TimedRun& run) {
  page::Table table{{"ms", "p50", "p90", "p99", "p99.9", "max", "sweeps"}, {}};
  for (const ProfileRow& row : profile_rows(run.files)) {
    const Percentiles p = percentiles_of(row.series.ms);
    table.rows.push_back({{name_of(row.name, row.kind)},
                          {number(p.p50)},
                          {number(p.p90)},
                          {number(p.p99)},
                          {number(p.p999)},
                          {number(p.max)},
                          {std::to_string(p.count)}});
  }
  return page::table(table);
}

/// Green or red where the sweeps, one by one, say so; what is left white may be chance.
page::Tone tone_of(const ProfileChange& change) {
  if (!change.is_significant()) return page::Tone::kNone;
  return change.slower_share > 0.5 ? page::Tone::kBad : page::Tone::kGood;
}

std::string percent_more(double ratio) {
  return std::isfinite(ratio) ? format("%+.1f %%", 100.0 * (ratio - 1.0)) : std::string();
}

std::string change_table(const TimedRun& before, const TimedRun& after) {
  page::Table table{
      {"ms", "p50: " + before.name, after.name, "p99: " + before.name, after.name, "slower in, % of sweeps"},
      {}};
  for (const ProfileChange& c : profile_changes(before.files, after.files))
    table.rows.push_back({{name_of(c.name, c.kind)},
                          {number(c.before.p50)},
                          {number(c.after.p50), percent_more(c.p50_ratio()), tone_of(c)},
                          {number(c.before.p99)},
                          {number(c.after.p99), percent_more(c.p99_ratio())},
                          {number(100.0 * c.slower_share)}});
  return page::table(table);
}

/// What each sweep cost, stage upon stage, the costliest first: where the tail comes from.
std::string costliest_sweeps(const TimedRun& run) {
  constexpr std::size_t kShown = 20;
  std::vector<const output::LatencyRow*> rows;
  for (const output::LatencyRow& row : run.files.latency) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const auto* a, const auto* b) { return cpu_of_all_ns(*a) > cpu_of_all_ns(*b); });
  rows.resize(std::min(rows.size(), kShown));
  page::Table table{{"sweep"}, {}};
  for (std::size_t stage = 0; stage < kNumStages; ++stage)
    table.head.emplace_back(output::stage_name(static_cast<StageId>(stage)));
  table.head.emplace_back("all");
  for (const output::LatencyRow* row : rows) {
    std::vector<page::Cell> cells{{std::to_string(row->sequence)}};
    for (const output::StageSplit& split : row->stages)
      cells.push_back({split.ran ? number(milliseconds(split.cpu_ns)) : std::string("–")});
    cells.push_back({number(milliseconds(cpu_of_all_ns(*row)))});
    table.rows.push_back(std::move(cells));
  }
  return page::table(table);
}

std::string lead(const ProfilePage& page) {
  const TimedRun& first = page.runs.front();
  std::string text = format("%zu sweeps", first.files.latency.size());
  if (!first.files.facts.source.empty()) text += " of " + first.files.facts.source;
  if (page.runs.size() == 2)
    return text + ", and another run beside it. Differences are from " + first.name + ".";
  if (!first.files.facts.is_live) return text + ", replayed as fast as possible: CPU time is what tells.";
  const DeadlineMisses misses = deadline_misses(first.files, page.deadline_ms);
  return text + format(", live; %zu had no refined pose within %g ms of their last packet.", misses.late,
                       page.deadline_ms);
}

}  // namespace

std::string profile_page(const ProfilePage& page) {
  const bool is_comparison = page.runs.size() == 2;
  std::string html;
  if (is_comparison)
    html += page::section(
        "Stage by stage",
        "The same sweeps of both runs are compared one by one: coloured is what differs in more "
        "of them than chance would have it once in a thousand times. Two runs at different load "
        "differ, too.",
        change_table(page.runs[0], page.runs[1]));
  html += latency_section(page.runs);
  for (const TimedRun& run : page.runs) {
    const std::string of = is_comparison ? ": " + run.name : "";
    html += page::section("Every duration" + of, "Milliseconds; percentiles are values that occurred.",
                          run_table(run));
    html += page::section("The costliest sweeps" + of, "CPU time of each stage, milliseconds.",
                          costliest_sweeps(run));
  }
  return page::document({is_comparison ? "Two runs' time" : "A run's time", lead(page), html, page.made_by});
}

}  // namespace pago::report
