// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <atomic>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/simulator/drive_name.hpp"
#include "pago/simulator/render.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "signals.hpp"

namespace pago::app {

namespace {

struct SimulateOptions {
  std::string source;
  std::vector<std::string> assignments;  // from --seed and the like
  std::string calibration;
  simulator::DriveFiles files;
  SettingsOptions settings;

  bool writes_files() const {
    return !(files.pcap.empty() && files.labels.empty() && files.calibration.empty() && files.truth.empty() &&
             files.kitti.empty() && files.pictures.empty());
  }
};

int simulate_command(const SimulateOptions& options) {
  constexpr std::string_view kPrefix = "sim:";
  if (!options.source.starts_with(kPrefix))
    throw Error(options.source, "is no simulated drive", "give sim:urban, or sim:rural,seed=2,seconds=60");
  Config config = options.settings.load();
  simulator::apply_drive_name(config, std::string_view(options.source).substr(kPrefix.size()));
  for (const std::string& assignment : options.assignments) set(config, assignment);
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  validate(config);

  stop_on_signals();
  ProgressLine line;
  const auto on_progress = [&](const Progress& progress) {
    const double sweeps = config.simulator.seconds * config.simulator.rotation_hz;
    line.count_to(static_cast<std::uint64_t>(progress.done / progress.total * sweeps));
    line.show(progress);
  };
  if (!options.writes_files()) {
    std::cout
        << simulator::cached_drive(config, simulator::default_cache(), on_progress, stop_flag()).string()
        << '\n';
    return 0;
  }
  const std::uint64_t sweeps = simulator::render(config, options.files, on_progress, stop_flag());
  std::cout << sweeps << " sweeps\n";
  if (!stop_requested()) return 0;
  std::cerr << "pago: stopped by a signal: the drive is shorter than it should be\n";
  return 1;
}

}  // namespace

void add_simulate_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "simulate",
      "a made-up drive with its truth; without files named, into the cache, whose folder is printed");
  const auto options = std::make_shared<SimulateOptions>();
  command
      .add_option("source", options->source,
                  "sim:WORLD, settings of [simulator] after commas: sim:urban,seed=2")
      ->type_name("SOURCE")
      ->required();
  const auto add_setting = [&](const char* flag, const char* key, const char* meaning) {
    command
        .add_option_function<std::string>(
            flag,
            [options, key](const std::string& value) {
              options->assignments.push_back(std::string("simulator.") + key + "=" + value);
            },
            meaning)
        ->type_name("N");
  };
  add_setting("--seed", "seed", "of world, drive and noise");
  add_setting("--seconds", "seconds", "length of the drive");
  command
      .add_option("--calibration", options->calibration,
                  "the unit's db.xml or ROS yaml; default: a made-up unit")
      ->type_name("FILE");
  const auto add_file = [&](const char* flag, std::filesystem::path& file, const char* meaning) {
    command.add_option(flag, file, meaning)->type_name("FILE");
  };
  add_file("--pcap", options->files.pcap, "packets as a capture");
  add_file("--labels", options->files.labels, "what each slot of each packet returned from");
  add_file("--calibration-out", options->files.calibration, "the unit's calibration as db.xml");
  add_file("--truth", options->files.truth,
           "TUM poses at 200 Hz; beside it, per sweep, its start, mid and end");
  CLI::Option* const kitti =
      command.add_option("--kitti", options->files.kitti, "new folder of scans with SemanticKITTI labels")
          ->type_name("DIR");
  command.add_option("--pictures", options->files.pictures, "folder: the middle scan as PNG")
      ->type_name("DIR");
  command
      .add_flag("--compensated", options->files.kitti_compensated,
                "scans of --kitti in the frame of their middle instead of raw")
      ->needs(kitti);
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return simulate_command(*options); }; });
}

}  // namespace pago::app
