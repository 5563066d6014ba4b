// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cinttypes>
#include <cmath>

#include "pago/core/text.hpp"
#include "pago/report/profile.hpp"

namespace pago::report {
namespace {

std::string losses(const TimedRun& run, double deadline_ms) {
  const output::RunFacts& facts = run.files.facts;
  std::string text =
      format("sweeps    %zu, dropped %" PRIu64, run.files.latency.size(), facts.dropped_sweeps());
  const char* separator = " (";
  for (const auto& [name, count] : facts.sweeps) {
    if (!name.starts_with("dropped: ") || count == 0) continue;
    text += separator + format("%" PRIu64 " ", count) + name.substr(std::string("dropped: ").size());
    separator = ", ";
  }
  if (*separator == ',') text += ")";
  if (!facts.is_live) return text + "; a replay, which runs as fast as it can: no waits, no deadlines\n";
  const DeadlineMisses misses = deadline_misses(run.files, deadline_ms);
  return text + format("; refined pose later than %g ms, or none: %zu of %zu\n", deadline_ms, misses.late,
                       misses.of);
}

std::string head(const TimedRun& run) {
  const std::string& source = run.files.facts.source;
  return "run       " + run.name + (source.empty() ? "" : " of " + source) + "\n";
}

std::string label(const std::string& name, TimeKind kind) {
  return format("  %-13s %-5s", name.c_str(), std::string(to_string(kind)).c_str());
}

}  // namespace

std::string profile_text(const TimedRun& run, double deadline_ms) {
  std::string text = head(run) + losses(run, deadline_ms) +
                     "ms                        p50      p90      p99    p99.9      max   sweeps\n";
  for (const ProfileRow& row : profile_rows(run.files)) {
    const Percentiles p = percentiles_of(row.series.ms);
    text += label(row.name, row.kind) +
            format(" %8.2f %8.2f %8.2f %8.2f %8.2f %8zu\n", p.p50, p.p90, p.p99, p.p999, p.max, p.count);
  }
  return text;
}

std::string profile_comparison_text(const TimedRun& before, const TimedRun& after, double deadline_ms) {
  std::string text = head(before) + losses(before, deadline_ms) + head(after) + losses(after, deadline_ms) +
                     "ms                    p50: 1        2    ratio   p99: 1        2    ratio  slower in\n";
  for (const ProfileChange& c : profile_changes(before.files, after.files)) {
    text += label(c.name, c.kind) + format(" %8.2f %8.2f %8.2f %8.2f %8.2f %8.2f", c.before.p50, c.after.p50,
                                           c.p50_ratio(), c.before.p99, c.after.p99, c.p99_ratio());
    text += c.num_pairs == 0
                ? std::string("          -\n")
                : format("  %7.0f %%%s\n", 100.0 * c.slower_share, c.is_significant() ? " *" : "");
  }
  return text +
         "slower in: part of the sweeps that took longer in the second run; * = not by chance (p < 0.001)\n";
}

}  // namespace pago::report
