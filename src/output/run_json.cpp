// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "pago/core/units.hpp"
#include "pago/output/run_report.hpp"

namespace pago::output {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const LatencyHistogram& histogram) {
  const LatencySummary s = summarize(histogram);
  return {{"count", s.count},
          {"p50", milliseconds(s.p50_ns)},
          {"p90", milliseconds(s.p90_ns)},
          {"p99", milliseconds(s.p99_ns)},
          {"max", milliseconds(s.max_ns)}};
}

Json json_of(const LatencyReport& latency) {
  Json json;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const LatencyReport::Stage& stage = latency.stages[i];
    if (stage.run.count() == 0) continue;
    json[std::string(stage_name(static_cast<StageId>(i)))] = {
        {"wait", json_of(stage.wait)}, {"run", json_of(stage.run)}, {"cpu", json_of(stage.cpu)}};
  }
  json["first_pose"] = json_of(latency.first_pose);
  json["refined_pose"] = json_of(latency.refined_pose);
  return json;
}

Json json_of(const SourceCounters& c) {
  return {{"received", c.received},
          {"delivered", c.delivered},
          {"filtered", c.filtered},
          {"truncated", c.truncated},
          {"fragment_lost", c.fragment_lost},
          {"malformed", c.malformed},
          {"kernel_dropped", c.kernel_dropped},
          {"balanced", c.balanced()}};
}

Json json_of(const PacketCounters& c) {
  Json bad;
  for (std::size_t i = 1; i < c.bad.size(); ++i)
    bad[std::string(to_string(static_cast<PacketFault>(i)))] = c.bad[i];
  return {{"received", c.received},   {"decoded", c.decoded},   {"duplicate", c.duplicate},
          {"late", c.late},           {"filtered", c.filtered}, {"bad", bad},
          {"reordered", c.reordered}, {"pending", c.pending},   {"balanced", c.balanced()}};
}

Json json_of(const FiringCounters& c) {
  return {{"expected", c.expected},
          {"decoded", c.decoded},
          {"lost", c.lost},
          {"blind", c.blind},
          {"balanced", c.balanced()}};
}

Json json_of(const SweepCounters& c) {
  Json dropped;
  for (std::size_t i = 0; i < c.dropped.size(); ++i)
    dropped[std::string(to_string(static_cast<SweepDrop>(i)))] = c.dropped[i];
  return {{"opened", c.opened}, {"posed", c.posed},         {"partial", c.partial},
          {"dropped", dropped}, {"in_flight", c.in_flight}, {"balanced", c.balanced()}};
}

Json trajectory_of(const RunTotals& totals) {
  Json health;
  for (std::size_t i = 0; i < totals.health.size(); ++i)
    health[std::string(to_string(static_cast<Health>(i)))] = totals.health[i];
  return {{"poses", totals.num_poses},
          {"length_m", totals.length_m},
          {"first_stamp_ns", totals.first_stamp_ns},
          {"last_stamp_ns", totals.last_stamp_ns},
          {"hash", totals.hash.hex()},
          {"health", health}};
}

/// A name that comes more than once (one "thread" per thread) holds a list.
Json facts_of(const RunReport& report) {
  Json facts = Json::object();
  for (const auto& [name, value] : report.facts) {
    if (!facts.contains(name)) {
      facts[name] = value;
      continue;
    }
    if (!facts[name].is_array()) facts[name] = Json::array({facts[name]});
    facts[name].push_back(value);
  }
  return facts;
}

/// Complete once the run is over and nothing of it was missed.
Json json_of(const DecisionLog& log, const RunReport& report) {
  const Decisions& d = log.decisions();
  return {{"complete", log.is_complete() && report.requests && report.unrecorded == 0},
          {"superseded", d.superseded},
          {"unmet", d.unmet},
          {"resets", d.resets}};
}

/// null where there is nothing of the kind.
template <typename Counters>
Json json_of(const std::optional<Counters>& counters) {
  return counters ? json_of(*counters) : Json();
}

}  // namespace

std::string run_json(const RunReport& report, const RunTotals& totals, const DecisionLog& decisions) {
  const Json json = {{"version", report.version},
                     {"source", report.source},
                     {"live", report.is_live},
                     {"complaint", report.complaint},
                     {"wall_s", report.wall_s},
                     {"facts", facts_of(report)},
                     {"trajectory", trajectory_of(totals)},
                     {"sweeps", json_of(report.sweeps)},
                     {"packets", json_of(report.packets)},
                     {"firings", json_of(report.firings)},
                     {"self_hits", report.self_hits},
                     {"unrecorded", report.unrecorded},
                     {"map",
                      {{"keyframes", totals.num_keyframes},
                       {"points", totals.num_map_points},
                       {"keyframes_missing", report.unmapped}}},
                     {"datagrams", json_of(report.source_counters)},
                     {"decisions", json_of(decisions, report)},
                     {"latency_ms", json_of(totals.latency)},
                     {"config", report.config_toml}};
  // Paths need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pago::output
