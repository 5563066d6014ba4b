// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "live_observer.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/output/results_folder.hpp"
#include "pago/output/run_recorder.hpp"
#include "pago/pcap/recording_source.hpp"
#include "pago/pipeline/paced_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/platform/memory.hpp"
#include "progress_line.hpp"
#include "recording.hpp"
#include "run.hpp"
#include "signals.hpp"

namespace pago::app {

namespace {

class ReplayObserver final : public Observer {
 public:
  explicit ReplayObserver(output::RunRecorder& recorder) : recorder_(recorder) {}
  void on_sweep(const output::SweepRecord& record) override {
    recorder_.add(record);
    line_.count(record);
  }
  void on_map_sweep(const output::MapSweep& sweep) override { recorder_.add(sweep); }
  void on_status(const IngestStatus& status) override { line_.show(status.progress); }

 private:
  output::RunRecorder& recorder_;
  ProgressLine line_;
};

Config load(const RunOptions& options) {
  Config config = options.settings.load();
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  if (!options.ground.empty()) config.ground.method = options.ground;
  if (!options.output.empty()) config.output.folder = options.output;
  if (!options.record.empty()) config.record.file = options.record;
  options.part.apply(config);
  validate(config);
  return config;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// For what is not real-time while it runs: files, messages, requests.
constexpr std::size_t kHeapReserve_bytes = 16U << 20U;

/// What a run needs, all of it open and made, so that nothing is refused after work has begun.
struct Prepared {
  OpenSource source;
  bool is_live;
  std::unique_ptr<Pipeline> pipeline;
  LiveOutlets outlets;
  std::string recorded_hash;  // of the live run's poses, if it is repeated

  OpenPackets* packets() { return std::get_if<OpenPackets>(&source); }
};

Prepared prepare(const RunOptions& options, Config& config) {
  Prepared run{.source = open_source(options.source, config),
               .is_live = false,
               .pipeline = {},
               .outlets = {},
               .recorded_hash = {}};
  const OpenPackets* const packets = run.packets();
  if (!options.as_recorded.empty() && (packets == nullptr || packets->is_live || options.is_paced()))
    throw Error(options.as_recorded, "goes with a capture of the live run's packets, replayed");
  if (packets == nullptr && options.is_paced())
    throw Error(options.source, "holds scans, which cannot be replayed in real time",
                "--realtime and --speed are for captures of packets");
  if (packets == nullptr && (options.part.is_given() || !options.calibration.empty()))
    throw Error(
        options.source, "holds scans",
        "--start, --duration and --calibration are for packets; kitti.first and kitti.count choose scans");
  if (options.speed && packets->is_live)
    throw Error(options.source, "is live and keeps its own pace", "--speed is for captures of packets");
  run.is_live = packets != nullptr && (packets->is_live || options.is_paced());
  if (!run.is_live && !config.record.file.empty())
    throw Error(config.record.file, "cannot be recorded: the source is not live",
                "--record keeps the packets of a live run");
  std::error_code unknown;
  if (std::filesystem::equivalent(config.record.file, options.source, unknown))
    throw Error(config.record.file, "is the source, and cannot be recorded to");
  if (run.is_live) {
    platform::keep_heap(kHeapReserve_bytes);
    platform::make_timers_exact();
  }
  const output::Decisions decisions =
      options.as_recorded.empty() ? output::Decisions{} : output::read_decisions(options.as_recorded);
  run.recorded_hash = decisions.hash;
  run.pipeline = std::make_unique<Pipeline>(config, run.is_live ? Pace::kLive : Pace::kReplay, decisions);
  if (run.is_live) {
    run.outlets = open_outlets(config);
    if (const std::string refusal = platform::lock_memory(); !refusal.empty())
      run.packets()->warnings.push_back(refusal);
  }
  return run;
}

/// "55043 datagrams in drive.pcap, 0 not written"
std::string recording_fact(const PcapRecorder& recorder) {
  const RecordCounters c = recorder.counters();
  return std::to_string(c.written) + " datagrams in " + recorder.files() + ", " +
         std::to_string(c.unwritten()) + " not written";
}

RunSummary go_live(Prepared& run,
                   const RunOptions& options,
                   const Config& config,
                   output::RunRecorder& recorder,
                   std::vector<std::string>& complaints) {
  const auto start = std::chrono::steady_clock::now();
  LiveObserver observer(
      run.outlets, options.source, config.mount, recorder,
      [&](const IngestStatus& now) {
        return report_so_far(now, recorder.totals(), options.source, config, seconds_since(start));
      },
      [&] { run.pipeline->request_reset(); });
  OpenPackets& open = *run.packets();
  for (const std::string& warning : open.warnings) observer.log().warn(warning);
  std::optional<PacedSource> paced;
  if (!open.is_live) paced.emplace(*open.packets, options.speed.value_or(1.0));
  PacketSource& source = paced ? *paced : *open.packets;
  std::optional<RecordingSource> recording;
  if (run.outlets.packets) recording.emplace(source, *run.outlets.packets);
  PacketSource& used = recording ? *recording : source;
  RunSummary summary = run.pipeline->run(used, open.calibration, observer, stop_flag());
  if (run.outlets.packets) run.outlets.packets->finish();
  for (const std::string& complaint : observer.complaints()) complaints.push_back(complaint);
  if (open.is_live && !summary.interrupted && summary.failure.empty()) summary.failure = summary.complaint;
  return summary;
}

RunSummary replay(Prepared& run, output::RunRecorder& recorder) {
  ReplayObserver observer(recorder);
  if (OpenPackets* const open = run.packets())
    return run.pipeline->run(*open->packets, open->calibration, observer, stop_flag());
  return run.pipeline->run(*std::get<OpenFolder>(run.source).sweeps, observer, stop_flag());
}

}  // namespace

RunOutcome run_source(const RunOptions& options) {
  stop_on_signals();
  Config config = load(options);
  Prepared run = prepare(options, config);
  if (const OpenPackets* open = run.packets(); open != nullptr && !open->calibration_note.empty())
    std::cout << "calibration  " << open->calibration_note << '\n';
  if (const OpenPackets* open = run.packets(); open != nullptr && !run.is_live)
    for (const std::string& warning : open->warnings) std::cerr << "pago: " << warning << '\n';
  const output::ResultsFolder results = output::create_results_folder(config.output.folder);
  auto recorder = std::make_unique<output::RunRecorder>(results.folder, config.output);

  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> complaints{results.complaint};
  RunSummary summary =
      run.is_live ? go_live(run, options, config, *recorder, complaints) : replay(run, *recorder);
  const bool is_mount_told = run.is_live && summary.mount.is_warning();
  summary.mount = summary.mount.concluded();

  output::RunReport report =
      report_of(summary, options.source, config, run.packets() != nullptr, seconds_since(start));
  report.is_live = run.is_live;
  const PcapRecorder* const recorded = run.outlets.packets.get();
  if (recorded != nullptr) report.facts.emplace_back("recorded", recording_fact(*recorded));
  recorder->finish(report);
  const bool came_to_nothing = !summary.failure.empty() && summary.sweeps.opened == 0;
  if (!came_to_nothing) std::cout << output::run_summary(report, recorder->totals(), results.folder);
  std::cout << height_line(summary.mount, config.mount);

  const auto add = [&complaints](const std::vector<std::string>& more) {
    complaints.insert(complaints.end(), more.begin(), more.end());
  };
  add({summary.complaint, summary.failure});
  add(doubts(summary, recorder->totals(), run.source));
  // A live run has warned when the verdict fell.
  if (!is_mount_told) add({ground::to_text(summary.mount, config.mount)});
  const bool is_repeated = run.recorded_hash.empty() || run.recorded_hash == recorder->totals().hash.hex();
  if (!is_repeated)
    add({"the poses are not those of " + options.as_recorded +
         ": its settings or calibration were others, or these are not the packets that it received"});
  add(recorder->complaints());
  if (!summary.balanced()) add({"the counters do not add up, see run.json"});
  for (const std::string& complaint : complaints)
    if (!complaint.empty()) std::cerr << "pago: " << complaint << '\n';
  const bool is_recorded = recorder->complaints().empty() && summary.unrecorded == 0 && is_repeated &&
                           (recorded == nullptr || recorded->complaint().empty());
  return {exit_code(summary, recorder->totals(), is_recorded, run.is_live), results.folder.string()};
}

void add_run_options(CLI::App& command, RunOptions& options) {
  command
      .add_option(
          "--calibration", options.calibration,
          "the unit's db.xml or ROS yaml, or `sensor`: the one that it sends itself (S2.1, S3); default: "
          "calibration.xml, .yaml or db.xml beside the capture, else the sensor's")
      ->type_name("FILE");
  command
      .add_option("--ground", options.ground,
                  "ground segmentation: patchwork (default), patchworkpp, lego, ...; pago config lists them")
      ->type_name("NAME");
  command.add_flag("--realtime", options.is_realtime,
                   "replay a capture at the pace of its recording, as if the sensor were live: poses are "
                   "published, and what comes too fast is dropped and counted");
  command
      .add_option("--speed", options.speed,
                  "--realtime, but so many times as fast as it was recorded (0.1 to 100)")
      ->check(CLI::Range(0.1, 100.0).description(""))
      ->type_name("X");
  command
      .add_option("--record", options.record,
                  "keep the packets of a live run in this capture, which replays to the same trajectory")
      ->type_name("FILE");
  command
      .add_option(
          "--as-recorded", options.as_recorded,
          "repeat what a live run dropped because of the clock: its run.json, with its recorded packets "
          "as source; the poses are then the same to the last bit")
      ->type_name("RUN.JSON");
  command
      .add_option("--output", options.output, "folder that gets a new folder for each run; default: results")
      ->type_name("DIR");
  options.part.add_to(command);
  options.settings.add_to(command);
}

void add_run_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("run", "packets or scans in, trajectory out");
  const auto options = std::make_shared<RunOptions>();
  command
      .add_option("source", options->source,
                  "udp://:2368 (a live sensor), drive.pcap, a folder of KITTI scans (kitti:sequences/00), or "
                  "sim:urban "
                  "(a made-up drive; sim:urban,seed=3,seconds=60)")
      ->type_name("SOURCE")
      ->required();
  add_run_options(command, *options);
  command.callback([&action, options] { action = [options] { return run_source(*options).exit_code; }; });
}

}  // namespace pago::app
