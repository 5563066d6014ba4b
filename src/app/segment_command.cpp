// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "mask_files.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/ground_report.hpp"
#include "pago/ground/ground_stage.hpp"
#include "pago/output/results_folder.hpp"
#include "pago/output/text_file.hpp"
#include "pago/pipeline/sweep_reader.hpp"
#include "pago/report/evaluation_page.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "signals.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

using evaluation::GroundComparison;
using evaluation::GroundProtocol;

struct SegmentOptions {
  std::string source, calibration, output = "segments";
  std::vector<std::string> methods;
  std::uint64_t most_sweeps = 0;
  MaskFiles::Kinds files;
  SettingsOptions settings;
};

/// One ground method at work, and what it found.
struct Contender {
  std::string name;
  ground::GroundStage stage;
  MaskFiles files;
  std::uint64_t num_ground = 0;

  void segment(Sweep& sweep) {
    stage.begin(sweep);
    stage.accept({&sweep, sweep.size, sweep.header.num_columns, true});
    stage.finish(sweep);
    num_ground += static_cast<std::uint64_t>(
        std::count(sweep.ground.data(), sweep.ground.data() + sweep.size, kGround));
    files.write(sweep);
  }
};

/// The scores of all methods on whole sweeps with labels, by both protocols, which stay apart.
class Judge {
 public:
  Judge(const std::vector<std::string>& methods, const Mount& mount) : mount_(mount) {
    for (GroundComparison& comparison : comparisons_)
      for (const std::string& method : methods) comparison.methods.push_back({method, {}});
    comparisons_[0].protocol = GroundProtocol::kPatchwork;
    comparisons_[1].protocol = GroundProtocol::kPatchworkPlusPlus;
  }

  static bool can_judge(const Sweep& sweep) { return sweep.header.has(kLabelled) && sweep.header.is_posed(); }

  void open(const Sweep& sweep) {
    for (GroundComparison& comparison : comparisons_) comparison.frames.push_back(sweep.header.sequence);
  }
  void judge(const Sweep& sweep, std::size_t method) {
    for (GroundComparison& comparison : comparisons_)
      comparison.methods[method].counts.push_back(count_ground(comparison.protocol, sweep, mount_));
  }

  std::size_t num_frames() const { return comparisons_[0].frames.size(); }

  /// Tables to the terminal, rows and the page into the folder; `part`: what the page's title adds.
  void report(const std::string& source, const std::string& part, const std::filesystem::path& folder) const {
    for (const GroundComparison& comparison : comparisons_) {
      std::cout << '\n' << ground_table(comparison);
      output::write_file(folder / ground_csv_name(comparison.protocol), ground_csv(comparison));
    }
    output::write_file(folder / "index.html",
                       report::ground_page("Ground segmentation of " + source + part, comparisons_,
                                           "pago " PAGO_VERSION " segment " + source));
  }

 private:
  Mount mount_;
  std::array<GroundComparison, 2> comparisons_;
};

std::vector<Contender> contenders(const SegmentOptions& options,
                                  const Config& config,
                                  const std::filesystem::path& folder) {
  std::vector<Contender> result;
  for (const std::string& method : options.methods) {
    GroundConfig ground = config.ground;
    ground.method = method;
    const auto max_returns = max_returns_of(config.assembly, /*can_be_dual=*/true);
    result.push_back({.name = method,
                      .stage = ground::GroundStage(ground, config.mount, max_returns),
                      .files = MaskFiles(folder / method, options.files)});
  }
  return result;
}

/// As named, without the blanks about them. Throws Error where one is named twice: its files would be too.
std::vector<std::string> distinct(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    const std::string trimmed = CLI::detail::trim_copy(name);
    if (std::ranges::find(result, trimmed) != result.end())
      throw Error("--ground", "names " + trimmed + " twice");
    result.push_back(trimmed);
  }
  return result;
}

OpenSource open_labelled(const SegmentOptions& options, Config& config) {
  OpenSource source = open_recording(options.source, config);
  for (const std::string& method : options.methods) require_labels(source, options.source, method);
  return source;
}

struct Done {
  std::uint64_t sweeps = 0, returns = 0;
  bool was_stopped = false;  // by a signal, with sweeps left

  /// Words for what is only a part of what was asked for; else empty.
  std::string complaint() const {
    return was_stopped ? format("stopped by a signal: masks and scores are of the first %llu sweeps",
                                static_cast<unsigned long long>(sweeps))
                       : "";
  }
};

Done segment_all(SweepReader& reader,
                 const OpenSource& source,
                 std::uint64_t most,
                 std::vector<Contender>& methods,
                 Judge& judge) {
  ProgressLine line;
  Done done;
  while (most == 0 || done.sweeps < most) {
    Sweep* const sweep = reader.next();
    if (sweep == nullptr) break;
    done.was_stopped = stop_requested();
    if (done.was_stopped) break;
    const bool is_judged = Judge::can_judge(*sweep);
    if (is_judged) judge.open(*sweep);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      methods[i].segment(*sweep);
      if (is_judged) judge.judge(*sweep, i);
    }
    done.returns += sweep->size;
    line.count_to(++done.sweeps);
    line.show(progress_of(source));
  }
  return done;
}

void print_shares(const std::vector<Contender>& methods, const Done& done) {
  std::cout << done.sweeps << " sweeps, " << done.returns << " returns\n";
  for (const Contender& method : methods)
    std::cout << format("  %-15s %6.2f %% ground\n", method.name.c_str(),
                        100.0 * static_cast<double>(method.num_ground) /
                            static_cast<double>(std::max<std::uint64_t>(done.returns, 1)));
}

int segment_command(SegmentOptions options) {
  stop_on_signals();
  Config config = options.settings.load();
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  if (options.methods.empty()) options.methods.push_back(config.ground.method);
  options.methods = distinct(options.methods);
  config.ground.method = options.methods.front();
  validate(config);
  OpenSource source = open_labelled(options, config);
  SweepReader reader = reader_of(source, config);
  const output::ResultsFolder results = output::create_results_folder(options.output);
  std::vector<Contender> methods = contenders(options, config, results.folder);
  Judge judge(options.methods, config.mount);

  const Done done = segment_all(reader, source, options.most_sweeps, methods, judge);
  if (done.sweeps == 0 && !done.was_stopped)
    throw Error(options.source, reader.failure().empty() ? "holds no sweep" : reader.failure());
  print_shares(methods, done);
  std::cout << height_line(methods.front().stage.mount_report(), config.mount);
  const std::string part = done.complaint().empty() ? "" : ", " + done.complaint();
  if (judge.num_frames() > 0) judge.report(options.source, part, results.folder);
  std::cout << "files     " << results.folder.string() << '\n';

  std::vector<std::string> complaints{results.complaint, done.complaint(), reader.failure()};
  if (const auto* open = std::get_if<OpenPackets>(&source)) complaints.push_back(open->packets->complaint());
  complaints.push_back(to_text(methods.front().stage.mount_report().concluded(), config.mount));
  for (const std::string& complaint : complaints)
    if (!complaint.empty()) std::cerr << "pago: " << complaint << '\n';
  return reader.failure().empty() ? 0 : 1;
}

}  // namespace

void add_segment_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "segment", "ground masks of recorded sweeps; precision and recall where there are labels");
  const auto options = std::make_shared<SegmentOptions>();
  command
      .add_option(
          "source", options->source,
          "drive.pcap, a folder of KITTI scans (kitti:sequences/00; with SemanticKITTI's labels/), or "
          "sim:urban")
      ->type_name("SOURCE")
      ->required();
  command
      .add_option("--ground", options->methods,
                  "methods to compare, by commas; default: ground.method (pago config lists them)")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      .add_option("--calibration", options->calibration,
                  "the unit's db.xml or ROS yaml; default: as for pago run")
      ->type_name("FILE");
  command.add_option("--sweeps", options->most_sweeps, "at most so many sweeps; default: all")
      ->check(CLI::Range(1, 1'000'000'000).description(""))
      ->type_name("N");
  command.add_flag("--ply", options->files.ply, "each sweep as a coloured PLY: ground green, all else red");
  command.add_flag("--pictures", options->files.picture, "each sweep from above as a PNG in these colours");
  command
      .add_option("--output", options->output,
                  "folder that gets a new folder for each call; default: segments")
      ->type_name("DIR");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return segment_command(*options); }; });
}

}  // namespace pago::app
