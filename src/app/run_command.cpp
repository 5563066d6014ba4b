// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/text.hpp"
#include "pago/output/results_folder.hpp"
#include "pago/output/run_recorder.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

struct RunOptions {
  std::string source, output, calibration, ground;
  SettingsOptions settings;
};

std::atomic<bool> stop_requested{false};

/// The first signal ends the run and flushes every output; a second one kills, as nothing may hang for ever.
void stop_on_signals() {
  const auto handler = [](int signal) {
    stop_requested.store(true, std::memory_order_relaxed);
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

class Recorder final : public Observer {
 public:
  explicit Recorder(output::RunRecorder& recorder) : recorder_(recorder) {}
  void on_sweep(const output::SweepRecord& record) override {
    recorder_.add(record);
    line_.count(record);
  }
  void on_progress(const Progress& progress) override { line_.show(progress); }

 private:
  output::RunRecorder& recorder_;
  ProgressLine line_;
};

Config load(const RunOptions& options) {
  Config config = options.settings.load();
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  if (!options.ground.empty()) config.ground.method = options.ground;
  if (!options.output.empty()) config.output.folder = options.output;
  validate(config);
  return config;
}

RunSummary run(Pipeline& pipeline, const OpenSource& source, output::RunRecorder& recorder) {
  Recorder observer(recorder);
  if (const auto* capture = std::get_if<OpenCapture>(&source)) {
    return pipeline.run(*capture->packets, capture->calibration, observer, stop_requested);
  }
  return pipeline.run(*std::get<OpenFolder>(source).sweeps, observer, stop_requested);
}

output::RunReport report_of(const RunSummary& summary,
                            const RunOptions& options,
                            const Config& config,
                            bool has_packets,
                            double wall_s) {
  output::RunReport report;
  report.version = PAGO_VERSION;
  report.source = options.source;
  report.config_toml = dump_toml(config);
  report.facts.emplace_back("ground", config.ground.method);
  report.facts.emplace_back("mount check", std::string(to_string(summary.mount.finding)));
  if (summary.mount.has_estimate)
    report.facts.emplace_back("ground below sensor", format("%.3f m", summary.mount.height_m));
  if (has_packets) {
    report.facts.emplace_back("sensor", summary.sensor);
    report.facts.emplace_back("calibration", config.hdl64.calibration);
    report.source_counters = summary.source;
    report.packets = summary.packets;
    report.firings = summary.firings;
  }
  for (const std::string& thread : summary.threads) report.facts.emplace_back("thread", thread);
  report.sweeps = summary.sweeps;
  report.wall_s = wall_s;
  report.complaint = summary.failure.empty() ? summary.complaint : summary.failure;
  if (report.complaint.empty() && summary.interrupted) report.complaint = "stopped by a signal";
  return report;
}

/// A stream that gave nothing is bad input; a run that broke off half-way, or lost count, has failed.
int exit_code(const RunSummary& summary, const output::RunTotals& totals, bool is_recorded) {
  if (!summary.failure.empty()) return totals.num_poses == 0 ? 2 : 1;
  return summary.balanced() && is_recorded ? 0 : 1;
}

/// What a user should know about a run that went through.
std::vector<std::string> doubts(const RunSummary& summary,
                                const output::RunTotals& totals,
                                const OpenSource& source,
                                const Mount& mount) {
  std::vector<std::string> result;
  if (summary.mount.is_warning()) result.push_back(ground::to_text(summary.mount, mount));
  const PacketCounters& packets = summary.packets;
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
  if (const auto* folder = std::get_if<OpenFolder>(&source)) {
    if (const auto scans = folder->sweeps->scans_with_guessed_rings(); scans > 0) {
      result.push_back(std::to_string(scans) +
                       " scans are not ring by ring as KITTI's are: their rings are guessed");
    }
  }
  return result;
}

int run_command(const RunOptions& options) {
  Config config = load(options);
  const bool is_calibration_chosen = !config.hdl64.calibration.empty();
  const OpenSource source = open_source(options.source, config);
  if (!is_calibration_chosen && !config.hdl64.calibration.empty()) {
    std::cout << "calibration  " << config.hdl64.calibration << ", found beside the capture\n";
  }
  Pipeline pipeline(config);
  const output::ResultsFolder results = output::create_results_folder(config.output.folder);
  auto recorder = std::make_unique<output::RunRecorder>(results.folder, config.output);
  stop_on_signals();

  const auto start = std::chrono::steady_clock::now();
  const RunSummary summary = run(pipeline, source, *recorder);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const bool has_packets = std::holds_alternative<OpenCapture>(source);
  const output::RunReport report = report_of(summary, options, config, has_packets, wall_s);
  recorder->finish(report);
  const bool came_to_nothing = !summary.failure.empty() && summary.sweeps.opened == 0;
  if (!came_to_nothing) std::cout << output::run_summary(report, recorder->totals(), results.folder);
  for (const std::string& complaint : {results.complaint, summary.complaint, summary.failure}) {
    if (!complaint.empty()) std::cerr << "pago: " << complaint << '\n';
  }
  for (const std::string& doubt : doubts(summary, recorder->totals(), source, config.mount))
    std::cerr << "pago: " << doubt << '\n';
  const std::vector<std::string> complaints = recorder->complaints();
  for (const std::string& complaint : complaints) std::cerr << "pago: " << complaint << '\n';
  if (!summary.balanced()) std::cerr << "pago: the counters do not add up, see run.json\n";
  return exit_code(summary, recorder->totals(), complaints.empty());
}

}  // namespace

void add_run_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("run", "packets or scans in, trajectory out");
  const auto options = std::make_shared<RunOptions>();
  command
      .add_option("source", options->source, "drive.pcap, or a folder of KITTI scans (kitti:sequences/00)")
      ->type_name("SOURCE")
      ->required();
  command
      .add_option(
          "--calibration", options->calibration,
          "the unit's db.xml or ROS yaml; default: calibration.xml, .yaml or db.xml beside the capture")
      ->type_name("FILE");
  command.add_option("--ground", options->ground, "ground segmentation: patchwork (default) or lego")
      ->type_name("NAME");
  command
      .add_option("--output", options->output, "folder that gets a new folder for each run; default: results")
      ->type_name("DIR");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return run_command(*options); }; });
}

}  // namespace pago::app
