// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "commands.hpp"
#include "demo/demo_report.hpp"
#include "demo/ground_scoring.hpp"
#include "demo/player.hpp"
#include "demo/pose_witness.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "pago/output/results_folder.hpp"
#include "pago/output/run_recorder.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/platform/clock.hpp"
#include "pago/platform/jitter.hpp"
#include "pago/platform/memory.hpp"
#include "pago/simulator/drive_name.hpp"
#include "pago/simulator/render.hpp"
#include "pago/udp/udp_source.hpp"
#include "progress_line.hpp"
#include "recording.hpp"
#include "settings.hpp"
#include "signals.hpp"

namespace pago::app {

namespace {

struct DemoOptions {
  std::string drive = "urban,seed=1,seconds=20", output;
  SettingsOptions settings;
};

/// Keeps every sweep and ends the run when the player has ended and nothing more comes.
class DemoObserver final : public Observer {
 public:
  DemoObserver(output::RunRecorder& recorder, Player& player, double seconds)
      : recorder_(recorder), player_(player), seconds_(seconds) {}

  void on_sweep(const output::SweepRecord& record) override {
    recorder_.add(record);
    records_.push_back(record);
    line_.count(record);
  }
  void on_map_sweep(const output::MapSweep& sweep) override { recorder_.add(sweep); }
  void on_status(const IngestStatus& status) override {
    line_.show({std::chrono::duration<double>(Clock::now() - start_).count(), seconds_});
    const bool is_silent = stream_state(status, platform::monotonic_ns()) != StreamState::kRunning;
    if (status.sweeps.is_open == 0 && is_silent && player_.has_ended()) is_over_ = true;
    if (stop_requested()) is_over_ = true;
  }
  const std::vector<output::SweepRecord>& records() const noexcept { return records_; }
  const std::atomic<bool>& is_over() const noexcept { return is_over_; }

 private:
  using Clock = std::chrono::steady_clock;
  output::RunRecorder& recorder_;
  Player& player_;
  double seconds_;
  Clock::time_point start_ = Clock::now();
  ProgressLine line_;
  std::vector<output::SweepRecord> records_;
  std::atomic<bool> is_over_{false};
};

Config load(const DemoOptions& options) {
  Config config = options.settings.load();
  simulator::apply_drive_name(config, options.drive);
  config.odometry.pose_instant = PoseInstant::kEnd;
  config.publish.shared_memory = "pago_demo_" + std::to_string(getpid());
  if (!options.output.empty()) config.output.folder = options.output;
  validate(config);
  return config;
}

std::filesystem::path render(const Config& config) {
  ProgressLine line;
  const auto on_progress = [&](const Progress& progress) {
    line.count_to(static_cast<std::uint64_t>(progress.done / std::max(1.0, progress.total) *
                                             config.simulator.seconds * config.simulator.rotation_hz));
    line.show(progress);
  };
  std::cout << "the drive is rendered once and kept in " << simulator::default_cache().string() << std::endl;
  return simulator::cached_drive(config, simulator::default_cache(), on_progress, stop_flag());
}

std::string latency_row(const char* name, const LatencyHistogram& histogram) {
  return format("  %-34s %8.2f %8.2f %8.2f %8.2f\n", name, milliseconds(histogram.percentile(50)),
                milliseconds(histogram.percentile(90)), milliseconds(histogram.percentile(99)),
                milliseconds(histogram.max()));
}

/// One line of judgement; true if it holds.
bool judge(const std::string& what, const std::string& figure, const std::string& bound, bool holds) {
  std::cout << (holds ? "ok    " : "FAIL  ") << what << "  " << figure << "  (bound: " << bound << ")\n";
  return holds;
}

/// Datagrams of a capture, all of which the player sends.
std::uint64_t count_datagrams(const std::filesystem::path& capture, const PacketFilterConfig& filter) {
  PcapSource source(capture, filter);
  while (!source.all_done()) source.receive();
  return source.counters().delivered;
}

bool judge(const DemoAccuracy& accuracy,
           const evaluation::GroundSummary& ground,
           const RunSummary& summary,
           std::uint64_t sent) {
  const DemoBounds bounds;
  bool holds = judge("sweeps with a pose", format("%zu of %zu", accuracy.num_poses, accuracy.num_rows),
                     "all, less one at either end", accuracy.num_poses + 2 >= accuracy.num_rows);
  holds &= judge("drift over 50 and 100 m",
                 format("%.3f %% (ATE %.3f m over %.0f m)", accuracy.drift.t_rel_percent, accuracy.ate_m,
                        accuracy.path_m),
                 format("below %.0f %%", bounds.max_drift_percent),
                 accuracy.drift.t_rel_percent < bounds.max_drift_percent);
  holds &= judge("ground, protocol B",
                 format("precision %.1f %%, recall %.1f %%, F1 %.1f %%", 100.0 * ground.mean.precision,
                        100.0 * ground.mean.recall, 100.0 * ground.mean.f1),
                 format("F1 at least %.0f %%", 100.0 * bounds.min_ground_f1),
                 ground.mean.f1 >= bounds.min_ground_f1);
  holds &= judge("sweeps dropped", std::to_string(summary.sweeps.dropped_total()), "0",
                 summary.sweeps.dropped_total() == 0);
  holds &= judge("datagrams dropped by the kernel", std::to_string(summary.source.kernel_dropped), "0",
                 summary.source.kernel_dropped == 0);
  holds &= judge("datagrams received or dropped",
                 std::to_string(summary.source.received + summary.source.kernel_dropped),
                 std::to_string(sent) + ", as many as were sent",
                 summary.source.received + summary.source.kernel_dropped == sent);
  holds &= judge("counters", summary.balanced() ? "add up" : "do not add up", "add up", summary.balanced());
  return holds;
}

int demo_command(const DemoOptions& options) {
  stop_on_signals();
  Config config = load(options);
  const simulator::DriveFiles drive = simulator::files_in(render(config));
  if (stop_requested()) return 1;
  config.hdl64.calibration = drive.calibration.string();
  const hdl64::Calibration calibration =
      hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);

  platform::make_timers_exact();
  UdpSource source({"127.0.0.1", 0}, config.packets, config.udp);
  Pipeline pipeline(config, Pace::kLive);
  PoseWitness witness(config.publish.shared_memory);
  const std::string refusal = platform::lock_memory();
  const output::ResultsFolder results = output::create_results_folder(config.output.folder);
  auto recorder = std::make_unique<output::RunRecorder>(results.folder, config.output);
  std::cout << "played in real time over UDP into the live pipeline, " << config.simulator.seconds << " s"
            << std::endl;
  Player player(drive.pcap, source.port());
  platform::JitterMeter jitter({.name = "jitter"}, 10'000'000);
  DemoObserver observer(*recorder, player, config.simulator.seconds);
  const auto start = std::chrono::steady_clock::now();
  const RunSummary summary = pipeline.run(source, calibration, observer, observer.is_over());
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const LatencyHistogram& bare_timer = jitter.stop();
  witness.stop();

  output::RunReport report = report_of(summary, "sim:" + options.drive, config, true, wall_s);
  report.is_live = true;
  if (!stop_requested()) report.complaint.clear();
  recorder->finish(report);
  std::cout << '\n'
            << output::run_summary(report, recorder->totals(), results.folder)
            << "from a sweep's last packet until          p50      p90      p99      max ms\n"
            << latency_row("another process held its first pose", witness.first())
            << latency_row("and its refined pose", witness.refined())
            << latency_row("a bare timer was late by", bare_timer);
  for (const std::string& thread : summary.threads) std::cout << "thread    " << thread << '\n';
  if (!refusal.empty()) std::cout << "note      " << refusal << '\n';
  if (stop_requested()) return 1;
  if (player.exit_code() != 0) throw std::runtime_error("the drive could not be played: `pago play` failed");

  const std::filesystem::path truth = drive.truth.parent_path() / (drive.truth.stem().string() + "_end.txt");
  const DemoAccuracy accuracy = judge_accuracy(observer.records(), truth.string());
  const evaluation::GroundSummary ground = score_ground(config, calibration, drive.pcap, drive.labels,
                                                        evaluation::GroundProtocol::kPatchworkPlusPlus);
  std::cout << '\n';
  return judge(accuracy, ground, summary, count_datagrams(drive.pcap, config.packets)) ? 0 : 1;
}

}  // namespace

void add_demo_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "demo",
      "a made-up drive, played live into the pipeline: accuracy, ground, latency. Exit code 1 if accuracy or "
      "accounting miss their bounds; latency is only shown");
  const auto options = std::make_shared<DemoOptions>();
  command
      .add_option("--drive", options->drive,
                  "as after sim: in other commands; default: urban,seed=1,seconds=20")
      ->type_name("DRIVE");
  command
      .add_option("--output", options->output, "folder that gets a new folder for each run; default: results")
      ->type_name("DIR");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return demo_command(*options); }; });
}

}  // namespace pago::app
