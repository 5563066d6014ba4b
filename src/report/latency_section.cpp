// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "pago/core/text.hpp"
#include "pago/page/chart.hpp"
#include "pago/page/html.hpp"
#include "pago/report/latency.hpp"

namespace pago::report {
namespace {

/// The series of that name, or nothing.
const LatencySeries* find(const std::vector<LatencySeries>& all, const std::string& name, bool is_cpu) {
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const LatencySeries& s) { return s.name == name && s.is_cpu == is_cpu; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> stages_that_ran(const std::vector<TimedRun>& runs) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const std::string name(output::stage_name(static_cast<StageId>(i)));
    if (std::any_of(runs.begin(), runs.end(), [&](const TimedRun& run) {
          return std::any_of(run.files.latency.begin(), run.files.latency.end(),
                             [i](const output::LatencyRow& row) { return row.stages[i].ran; });
        }))
      names.push_back(name);
  }
  return names;
}

/// CPU of all stages of several runs, over each other.
std::string cpu_histogram(const std::vector<TimedRun>& runs) {
  constexpr std::size_t kBins = 40;
  page::Chart chart{.title = "CPU of all stages",
                    .x = {.label = "ms", .is_log = true},
                    .y = {.label = "% of the sweeps"},
                    .series = {}};
  std::vector<double> all_ms;
  std::vector<std::vector<double>> of_runs(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<LatencySeries> series = latency_series(runs[i].files.latency);
    if (const LatencySeries* found = find(series, "all stages", true)) of_runs[i] = found->ms;
    all_ms.insert(all_ms.end(), of_runs[i].begin(), of_runs[i].end());
  }
  const std::vector<double> edges = page::histogram(all_ms, kBins, true).x;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    page::Series series = page::histogram(of_runs[i], edges);
    for (double& count : series.y)
      count *= 100.0 / static_cast<double>(std::max<std::size_t>(1, of_runs[i].size()));
    series.name = runs.size() == 1 ? "" : runs[i].name;
    series.colour = i;
    if (!of_runs[i].empty()) chart.series.push_back(std::move(series));
  }
  return figure(chart);
}

std::string first_pose_course(const std::vector<TimedRun>& runs) {
  page::Chart chart{.title = "Time to the first pose",
                    .x = {.label = "sweep"},
                    .y = {.label = "ms", .is_log = true},
                    .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<LatencySeries> all = latency_series(runs[i].files.latency);
    const LatencySeries* const series = find(all, "first pose", false);
    if (series == nullptr) continue;
    chart.series.push_back(
        {.name = runs.size() == 1 ? "" : runs[i].name, .x = series->sweeps, .y = series->ms, .colour = i});
  }
  return figure(chart);
}

std::string cpu_table(const std::vector<TimedRun>& runs) {
  page::Table table{{"ms", "first pose, wall: p50", "p99", "refined pose, wall: p50", "p99",
                     "CPU of all stages: p50", "p99", "dropped sweeps"},
                    {}};
  for (const TimedRun& run : runs) {
    if (run.files.latency.empty()) continue;
    const std::vector<LatencySeries> all = latency_series(run.files.latency);
    std::vector<page::Cell> row{{run.name}};
    for (const auto& [name, is_cpu] :
         {std::pair{"first pose", false}, std::pair{"refined pose", false}, std::pair{"all stages", true}}) {
      const LatencySeries* const series = find(all, name, is_cpu);
      const Percentiles p = percentiles_of(series == nullptr ? std::vector<double>{} : series->ms);
      row.push_back({page::number(p.p50)});
      row.push_back({page::number(p.p99)});
    }
    row.push_back({std::to_string(run.files.facts.dropped_sweeps())});
    table.rows.push_back(std::move(row));
  }
  return page::table(table);
}

std::string cpu_bars(const std::vector<TimedRun>& runs) {
  page::BarChart chart{.title = "CPU per sweep and stage",
                       .caption = "Median of the thread's CPU time.",
                       .label = "ms",
                       .categories = stages_that_ran(runs),
                       .series = {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].files.latency.empty()) continue;
    const std::vector<LatencySeries> all = latency_series(runs[i].files.latency);
    page::BarChart::Bars bars{runs[i].name, {}, i};
    for (const std::string& stage : chart.categories) {
      const LatencySeries* const series = find(all, stage, true);
      bars.values.push_back(series == nullptr ? std::nan("") : percentiles_of(series->ms).p50);
    }
    chart.series.push_back(std::move(bars));
  }
  return figure(chart);
}

}  // namespace

std::string latency_section(const std::vector<TimedRun>& runs) {
  if (std::all_of(runs.begin(), runs.end(), [](const TimedRun& run) { return run.files.latency.empty(); }))
    return {};
  return page::section(
      "What it takes",
      "Wall time counts from the arrival of a sweep's last packet; in a replay that runs as fast "
      "as it can, sweeps wait for each other by design, and CPU time is what tells.",
      cpu_table(runs) + page::grid(cpu_bars(runs) + cpu_histogram(runs) + first_pose_course(runs)));
}

}  // namespace pago::report
