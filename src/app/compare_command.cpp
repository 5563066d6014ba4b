// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/scan_statistics.hpp"
#include "pago/output/text_file.hpp"
#include "pago/report/scan_page.hpp"
#include "progress_line.hpp"
#include "scanning.hpp"
#include "settings.hpp"
#include "signals.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

struct CompareOptions {
  std::vector<std::string> sources;
  std::string html;
  bool json = false;
  std::uint64_t most_sweeps = 0;
  SettingsOptions settings;
};

evaluation::ScannedDrive scan(const std::string& name, const CompareOptions& options) {
  Config config = options.settings.load();
  validate(config);
  OpenSource source = open_recording(name, config);
  SweepReader reader = reader_of(source, config);
  Scanning scanning(config);
  ProgressLine line;
  std::uint64_t sweeps = 0;
  while (options.most_sweeps == 0 || sweeps < options.most_sweeps) {
    Sweep* const sweep = reader.next();
    if (sweep == nullptr) break;
    if (stop_requested()) throw Error(name, "stopped by a signal: nothing is compared");
    if (!sweep->header.is_posed()) continue;
    scanning.add(*sweep);
    line.count_to(++sweeps);
    line.show(progress_of(source));
  }
  if (!reader.failure().empty()) throw Error(name, reader.failure());
  if (sweeps == 0) throw Error(name, "holds no whole sweep");
  return {name, std::move(scanning.statistics())};
}

int compare_command(const CompareOptions& options) {
  stop_on_signals();
  std::vector<evaluation::ScannedDrive> drives;
  for (const std::string& name : options.sources) drives.push_back(scan(name, options));
  std::cout << (options.json ? scan_json(drives) : scan_table(drives));
  if (options.html.empty()) return 0;
  std::string made_by = "pago " PAGO_VERSION " compare";
  for (const std::string& name : options.sources) made_by += ' ' + name;
  output::write_file(options.html, report::scan_page(drives, made_by));
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "compare", "what the sweeps of drives look like, side by side: real ones and simulated ones");
  const auto options = std::make_shared<CompareOptions>();
  command
      .add_option("sources", options->sources,
                  "drive.pcap, folders of KITTI scans (kitti:sequences/00), sim:urban")
      ->type_name("SOURCE...")
      ->required();
  command.add_option("--html", options->html, "a page that needs nothing but this file")->type_name("FILE");
  command.add_flag("--json", options->json, "figures and curves as JSON, not as a table");
  command.add_option("--sweeps", options->most_sweeps, "at most so many sweeps of each; default: all")
      ->check(CLI::Range(1, 1'000'000'000).description(""))
      ->type_name("N");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return compare_command(*options); }; });
}

}  // namespace pago::app
