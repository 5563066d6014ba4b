// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <vector>

#include "baseline/baseline.hpp"
#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/output/results_folder.hpp"
#include "pago/output/run_report.hpp"
#include "pago/output/text_file.hpp"
#include "pago/output/trajectory_writer.hpp"
#include "pago/platform/clock.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "signals.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

struct BaselineOptions {
  std::string source, calibration, output = "baselines";
  SettingsOptions settings;
};

/// The instant that `pago run` would give the pose of.
std::int64_t reported_ns(const SweepHeader& header, PoseInstant instant) {
  if (!header.has(kCompensated) && instant == PoseInstant::kStart) return header.start_ns;
  if (!header.has(kCompensated) && instant == PoseInstant::kEnd) return header.end_ns;
  return header.start_ns + (header.end_ns - header.start_ns) / 2;
}

struct Driven {
  std::uint64_t poses = 0;
  std::int64_t cpu_ns = 0;
};

Driven drive(SweepReader& reader,
             const OpenSource& source,
             PoseInstant instant,
             output::TrajectoryWriter& trajectory) {
  baseline::Odometry odometry;
  ProgressLine line;
  Driven driven;
  for (Sweep* sweep = nullptr; !stop_requested() && (sweep = reader.next()) != nullptr;) {
    if (!sweep->header.is_posed()) continue;
    const std::int64_t start_ns = platform::thread_cpu_ns();
    const baseline::MovingPose& pose = odometry.add(*sweep);
    driven.cpu_ns += platform::thread_cpu_ns() - start_ns;
    const std::int64_t at_ns = reported_ns(sweep->header, instant);
    trajectory.write(at_ns + sweep->header.clock_offset_ns, output::to_row(pose.at(at_ns)));
    line.count_to(++driven.poses);
    line.show(progress_of(source));
  }
  trajectory.flush();
  return driven;
}

/// What `pago evaluate` asks of a folder: whose settings these poses are of.
void write_run_json(const std::filesystem::path& folder,
                    const std::string& source,
                    const Config& config,
                    const Driven& driven) {
  output::RunReport report;
  report.version = PAGO_VERSION;
  report.source = source;
  report.config_toml = dump_toml(config);
  report.facts.emplace_back("method", "pago baseline");
  const auto totals = std::make_unique<output::RunTotals>();
  totals->num_poses = driven.poses;
  output::write_file(folder / "run.json", output::run_json(report, *totals));
}

int baseline_command(const BaselineOptions& options) {
  stop_on_signals();
  Config config = options.settings.load();
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  validate(config);
  OpenSource source = open_recording(options.source, config);
  SweepReader reader = reader_of(source, config);
  const output::ResultsFolder results = output::create_results_folder(options.output);
  output::TrajectoryWriter trajectory(results.folder, "trajectory");

  const Driven driven = drive(reader, source, config.odometry.pose_instant, trajectory);
  if (driven.poses == 0)
    throw Error(options.source, reader.failure().empty() ? "holds no whole sweep" : reader.failure());
  write_run_json(results.folder, options.source, config, driven);
  std::cout << format("poses     %llu, %.1f ms of CPU each\n", static_cast<unsigned long long>(driven.poses),
                      static_cast<double>(driven.cpu_ns) * 1e-6 / static_cast<double>(driven.poses))
            << "files     " << results.folder.string() << '\n';
  const OpenPackets* const packets = std::get_if<OpenPackets>(&source);
  for (const std::string& complaint : {results.complaint, reader.failure(), trajectory.complaint(),
                                       packets == nullptr ? std::string() : packets->packets->complaint()}) {
    if (!complaint.empty()) std::cerr << "pago: " << complaint << '\n';
  }
  return reader.failure().empty() && trajectory.complaint().empty() ? 0 : 1;
}

}  // namespace

void add_baseline_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "baseline", "the trajectory of a plain point-to-point odometry, to compare pago run with");
  const auto options = std::make_shared<BaselineOptions>();
  command
      .add_option("source", options->source,
                  "drive.pcap, a folder of KITTI scans (kitti:sequences/00), or sim:urban")
      ->type_name("SOURCE")
      ->required();
  command
      .add_option("--calibration", options->calibration,
                  "the unit's db.xml or ROS yaml; default: as for pago run")
      ->type_name("FILE");
  command
      .add_option("--output", options->output,
                  "folder that gets a new folder for each call; default: baselines")
      ->type_name("DIR");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return baseline_command(*options); }; });
}

}  // namespace pago::app
