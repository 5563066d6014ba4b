// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cinttypes>

#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "pago/output/run_report.hpp"

namespace pago::output {
namespace {

/// ", 3 bad (2 size, 1 stamp)": the sum, and each cause that occurred.
template <typename Cause, std::size_t N>
std::string by_cause(const char* what, std::uint64_t total, const std::array<std::uint64_t, N>& counts) {
  std::string causes;
  for (std::size_t i = 0; i < N; ++i)
    if (counts[i] != 0)
      causes += format("%s%" PRIu64 " %s", causes.empty() ? "" : ", ", counts[i],
                       std::string(to_string(static_cast<Cause>(i))).c_str());
  return format(", %" PRIu64 " %s", total, what) + (causes.empty() ? "" : " (" + causes + ")");
}

/// Every count that must add up and does not is a defect of the program: say so where it is seen.
std::string check(bool is_balanced) {
  return is_balanced ? "\n" : "  NOT BALANCED: a defect, please report\n";
}

std::string sweeps(const SweepCounters& c) {
  std::string text = format("sweeps    %" PRIu64 " with a pose, %" PRIu64 " partial", c.posed, c.partial);
  if (c.in_flight != 0) text += format(", %" PRIu64 " unfinished", c.in_flight);
  return text + by_cause<SweepDrop>("dropped", c.dropped_total(), c.dropped) + check(c.balanced());
}

std::string packets(const RunReport& report) {
  std::string text;
  if (report.packets) {
    const PacketCounters& c = *report.packets;
    text += format("packets   %" PRIu64 " decoded of %" PRIu64 ", %" PRIu64 " duplicate, %" PRIu64 " late",
                   c.decoded, c.received, c.duplicate, c.late);
    if (c.filtered != 0) text += format(", %" PRIu64 " of other senders", c.filtered);
    if (c.pending != 0) text += format(", %" PRIu64 " held back", c.pending);
    text += by_cause<PacketFault>("bad", c.bad_total(), c.bad) + check(c.balanced());
  }
  if (report.source_counters && report.source_counters->kernel_dropped != 0)
    text += format("kernel    %" PRIu64 " datagrams dropped: the receive buffer was full\n",
                   report.source_counters->kernel_dropped);
  if (report.firings && report.firings->lost != 0)
    text +=
        format("firings   %" PRIu64 " of %" PRIu64 " lost", report.firings->lost, report.firings->expected) +
        check(report.firings->balanced());
  return text;
}

std::string trajectory(const RunTotals& totals) {
  std::string text =
      format("length    %.2f m in %" PRIu64 " poses, hash ", totals.length_m, totals.num_poses) +
      totals.hash.hex();
  const char* separator = "\nhealth    ";
  for (std::size_t i = 0; i < totals.health.size(); ++i) {
    if (totals.health[i] == 0) continue;
    text += format("%s%s %" PRIu64, separator, std::string(to_string(static_cast<Health>(i))).c_str(),
                   totals.health[i]);
    separator = ", ";
  }
  return text + "\n";
}

std::string map(const RunTotals& totals) {
  if (totals.num_keyframes == 0) return {};
  return format("map       %" PRIu64 " points of %" PRIu64 " keyframes\n", totals.num_map_points,
                totals.num_keyframes);
}

std::string columns(const LatencySummary& s) {
  return format(" %8.2f %8.2f %8.2f %8.2f", milliseconds(s.p50_ns), milliseconds(s.p90_ns),
                milliseconds(s.p99_ns), milliseconds(s.max_ns));
}

std::string latency(const LatencyReport& report, bool is_live) {
  std::string text = "latency ms      cpu p50      p90      p99      max";
  text += is_live ? "     wall p50      p90      p99      max\n" : "\n";
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const LatencyReport::Stage& stage = report.stages[i];
    if (stage.run.count() == 0) continue;
    text += format("  %-12s", std::string(stage_name(static_cast<StageId>(i))).c_str()) +
            columns(summarize(stage.cpu)) + (is_live ? "    " + columns(summarize(stage.run)) : "") + "\n";
  }
  if (!is_live) return text;
  const std::string blank(40, ' ');
  if (report.first_pose.count() != 0)
    text += "  first pose  " + blank + columns(summarize(report.first_pose)) + "\n";
  if (report.refined_pose.count() != 0)
    text += "  refined pose" + blank + columns(summarize(report.refined_pose)) + "\n";
  return text;
}

}  // namespace

std::string run_summary(const RunReport& report,
                        const RunTotals& totals,
                        const std::filesystem::path& folder) {
  std::string text = sweeps(report.sweeps) + packets(report) + trajectory(totals) + map(totals) +
                     latency(totals.latency, report.is_live);
  if (!report.complaint.empty()) text += "problem   " + report.complaint + "\n";
  return text + "files     " + folder.string() + "\n";
}

}  // namespace pago::output
