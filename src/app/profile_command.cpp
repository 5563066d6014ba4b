// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"
#include "pago/report/profile.hpp"
#include "run.hpp"

namespace pago::app {

namespace {

struct ProfileOptions {
  RunOptions run;  // its source may also be a results folder
  std::vector<std::string> compared;
  double deadline_ms = 100.0;
  std::string html;
};

output::RunFiles timed_files(const std::string& folder) {
  output::RunFiles files = output::read_run_files(folder);
  if (files.latency.empty())
    throw Error(folder, "holds no latency.csv with sweeps", "did the run finish one?");
  return files;
}

void write_page(const ProfileOptions& options, std::vector<report::TimedRun> runs) {
  if (options.html.empty()) return;
  std::string made_by = "pago " PAGO_VERSION " profile";
  for (const report::TimedRun& run : runs) made_by += " " + run.files.folder.string();
  output::write_file(options.html, report::profile_page({std::move(runs), options.deadline_ms, made_by}));
}

int compare(const ProfileOptions& options) {
  const std::vector<std::string> names = report::short_names(options.compared);
  std::vector<report::TimedRun> runs;
  for (std::size_t i = 0; i < options.compared.size(); ++i)
    runs.push_back({names[i], timed_files(options.compared[i])});
  std::cout << profile_comparison_text(runs[0], runs[1], options.deadline_ms);
  write_page(options, std::move(runs));
  return 0;
}

int profile(const ProfileOptions& options) {
  std::string folder = options.run.source;
  int exit_code = 0;
  if (!output::is_results_folder(folder)) {
    const RunOutcome outcome = run_source(options.run);
    exit_code = outcome.exit_code;
    folder = outcome.folder;
    std::cout << '\n';
  }
  const report::TimedRun run{folder, timed_files(folder)};
  std::cout << profile_text(run, options.deadline_ms);
  write_page(options, {run});
  return exit_code;
}

}  // namespace

void add_profile_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("profile", "where the time of a run goes; two runs compared");
  const auto options = std::make_shared<ProfileOptions>();
  CLI::Option* const source =
      command
          .add_option("source", options->run.source,
                      "the results folder of a run; or what pago run takes, which is run first")
          ->type_name("SOURCE");
  CLI::Option* const compared =
      command
          .add_option(
              "--compare", options->compared,
              "two results folders: stage by stage, and sweep by sweep where they are of the same drive")
          ->expected(2)
          ->type_name("A B")
          ->excludes(source);
  command
      .add_option("--deadline", options->deadline_ms,
                  "live runs: a refined pose later than this after its sweep's last packet is a miss (100)")
      ->check(CLI::Range(1.0, 10000.0).description(""))
      ->type_name("MS");
  command.add_option("--html", options->html, "write a page with figures: one file, opens without network")
      ->type_name("FILE");
  add_run_options(command, options->run);
  command.callback([&action, options, source, compared] {
    if (source->count() == 0 && compared->count() == 0)
      throw CLI::RequiredError("SOURCE, or --compare with two results folders,");
    action = [options] { return options->compared.empty() ? profile(*options) : compare(*options); };
  });
}

}  // namespace pago::app
