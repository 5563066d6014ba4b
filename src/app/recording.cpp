// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "recording.hpp"

#include "pago/config/load.hpp"
#include "pago/core/text.hpp"

namespace pago::app {

namespace {

output::RunReport common_report(const std::string& source, const Config& config, double wall_s) {
  output::RunReport report;
  report.version = PAGO_VERSION;
  report.source = source;
  report.config_toml = dump_toml(config);
  report.facts.emplace_back("ground", config.ground.method);
  report.wall_s = wall_s;
  return report;
}

/// What the sensor is and says of itself; of an early one, which says nothing, its name.
void add_sensor(output::RunReport& report,
                const std::string& sensor,
                const hdl64::SensorStatus& said,
                const Config& config) {
  report.facts.emplace_back("sensor", sensor);
  report.facts.emplace_back("calibration", config.hdl64.calibration);
  if (said.gps == hdl64::GpsState::kUnknown) return;
  if (said.firmware != 0) report.facts.emplace_back("firmware", hdl64::firmware_of(said));
  report.facts.emplace_back("GPS", std::string(to_string(said.gps)));
  report.facts.emplace_back("sensor temperature", format("%d C", said.temperature_c));
  for (const std::string& warning : hdl64::warnings_of(said))
    report.facts.emplace_back("sensor warning", warning);
}

}  // namespace

output::RunReport report_of(const RunSummary& summary,
                            const std::string& source,
                            const Config& config,
                            bool has_packets,
                            double wall_s) {
  output::RunReport report = common_report(source, config, wall_s);
  report.facts.emplace_back("mount check", std::string(to_string(summary.mount.finding)));
  if (summary.mount.has_estimate)
    report.facts.emplace_back("ground below sensor", format("%.3f m", summary.mount.height_m));
  if (summary.mount.set_height_m > 0.0)
    report.facts.emplace_back("sensor height, estimated", format("%.3f m", summary.mount.set_height_m));
  if (has_packets) {
    add_sensor(report, summary.sensor, summary.said, config);
    report.source_counters = summary.source;
    report.packets = summary.packets;
    report.firings = summary.firings;
  }
  for (const std::string& thread : summary.threads) report.facts.emplace_back("thread", thread);
  report.sweeps = summary.sweeps;
  report.requests = summary.requests;
  report.self_hits = summary.self_hits;
  report.unrecorded = summary.unrecorded;
  report.unmapped = summary.unmapped;
  report.complaint = summary.failure.empty() ? summary.complaint : summary.failure;
  if (report.complaint.empty() && summary.interrupted) report.complaint = "stopped by a signal";
  return report;
}

namespace {

/// Of what has come out so far; the rest of what was begun is under way.
SweepCounters sweeps_so_far(const AssemblyCounters& assembled, const output::RunTotals& totals) {
  SweepCounters sweeps;
  sweeps.opened = assembled.opened;
  sweeps.posed = totals.num_poses;
  sweeps.partial = totals.partial;
  sweeps.dropped[static_cast<std::size_t>(SweepDrop::kNoFreeSweep)] = assembled.no_free_sweep;
  sweeps.dropped[static_cast<std::size_t>(SweepDrop::kSuperseded)] = totals.superseded;
  sweeps.in_flight = sweeps.opened - sweeps.posed - sweeps.partial - sweeps.dropped_total();
  return sweeps;
}

}  // namespace

output::RunReport report_so_far(const IngestStatus& status,
                                const output::RunTotals& totals,
                                const std::string& source,
                                const Config& config,
                                double wall_s) {
  output::RunReport report = common_report(source, config, wall_s);
  add_sensor(report, std::string(hdl64::name(status.sensor)), status.said, config);
  report.source_counters = status.source;
  report.packets = status.packets;
  report.firings = status.firings;
  report.sweeps = sweeps_so_far(status.sweeps, totals);
  report.complaint = "saved while running";
  return report;
}

std::vector<std::string> doubts(const RunSummary& summary,
                                const output::RunTotals& totals,
                                const OpenSource& source) {
  std::vector<std::string> result;
  const PacketCounters& packets = summary.packets;
  for (const std::string& warning : hdl64::warnings_of(summary.said))
    result.push_back("the sensor says: " + warning);
  if (summary.failure.empty() && totals.num_poses == 0)
    result.emplace_back("no complete rotation, so no pose");
  if (packets.late + packets.duplicate > packets.decoded / 10) {
    result.emplace_back(
        "many packets are late or duplicate: if several sensors send to this port, choose one by "
        "packets.source_address");
  }
  if (packets.bad_total() > packets.decoded) result.emplace_back("most packets are damaged, see run.json");
  if (summary.clock_restarts > 0) {
    result.push_back("the sensor's clock began anew " + std::to_string(summary.clock_restarts) +
                     " times (switched off and on, or GPS found): the motion in between is unknown");
  }
  if (summary.unrecorded > 0) {
    result.push_back(std::to_string(summary.unrecorded) +
                     " sweeps and poses are missing in the files: the disk was too slow");
  }
  if (summary.unmapped > 0) {
    result.push_back(std::to_string(summary.unmapped) +
                     " keyframes are missing in the map: the disk or the machine was too slow");
  }
  if (const auto* folder = std::get_if<OpenFolder>(&source)) {
    if (const auto scans = folder->sweeps->missing_scans(); scans > 0) {
      result.push_back(std::to_string(scans) +
                       " scans are missing (their file numbers are skipped): behind a gap, rows of the "
                       "trajectory are not the scans' numbers");
    }
    if (const auto scans = folder->sweeps->scans_with_guessed_rings(); scans > 0) {
      result.push_back(std::to_string(scans) +
                       " scans are not ring by ring as KITTI's are: their rings are guessed");
    }
  }
  return result;
}

int exit_code(const RunSummary& summary, const output::RunTotals& totals, bool is_recorded, bool is_live) {
  // A sensor that never came is no fault of a run that was stopped while it waited.
  const bool has_failed = !summary.failure.empty() && !(is_live && summary.interrupted);
  if (has_failed) return totals.num_poses == 0 ? 2 : 1;
  return summary.balanced() && is_recorded ? 0 : 1;
}

}  // namespace pago::app
