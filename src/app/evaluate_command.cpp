// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "commands.hpp"
#include "estimates.hpp"
#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "pago/evaluation/comparison.hpp"
#include "pago/evaluation/evaluation.hpp"
#include "pago/output/text_file.hpp"
#include "pago/report/evaluation_page.hpp"

namespace pago::app {

namespace {

using evaluation::Alignment;
using evaluation::Matching;
using evaluation::PoseFrame;
using Unit = evaluation::PairOptions::Unit;

struct EvaluateOptions {
  std::string truth, rows, camera_calibration, truth_at, estimate_at, html, ground;
  std::string truth_times, estimate_times;
  std::vector<std::string> estimates;
  std::vector<double> truth_mount;
  std::string match = "auto", truth_frame = "sensor", estimate_frame = "sensor", poses = "refined";
  std::string align = "se3", pair_unit = "m";
  evaluation::EvaluationOptions evaluation;
  bool json = false;
};

const std::map<std::string, Matching> kMatchings{
    {"auto", Matching::kAuto}, {"row", Matching::kRow}, {"stamp", Matching::kStamp}};
const std::map<std::string, PoseFrame> kFrames{{"sensor", PoseFrame::kSensor},
                                               {"camera", PoseFrame::kCamera}};
const std::map<std::string, Alignment> kAlignments{{"se3", Alignment::kSe3},
                                                   {"yaw", Alignment::kYaw},
                                                   {"first", Alignment::kFirstPose},
                                                   {"none", Alignment::kNone}};
const std::map<std::string, PoseInstant> kInstants{
    {"start", PoseInstant::kStart}, {"mid", PoseInstant::kMid}, {"end", PoseInstant::kEnd}};
const std::map<std::string, Unit> kUnits{{"m", Unit::kMetres}, {"rows", Unit::kRows}};
const std::map<std::string, std::string> kPoses{
    {"refined", "trajectory"}, {"first", "odometry"}, {"front_end", "front_end"}};

/// The library's own descriptions of these checks would print enum values into the help.
template <typename Words>
CLI::Validator words(const Words& known) {
  return CLI::IsMember(known).description("");
}
CLI::Validator positive() {
  const auto complaint = [](const std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && value > 0.0 ? std::string()
                                                                 : text + " is no number above 0";
  };
  return CLI::Validator(complaint, "");
}

void add_matching_options(CLI::App& command, EvaluateOptions& options) {
  auto& match = options.evaluation.match;
  const char* const group = "Which poses belong together";
  command.add_option("--rows", options.rows, "score rows A to B only, counted from 0")
      ->type_name("A-B")
      ->group(group);
  command.add_option("--match", options.match, "auto, row, stamp")
      ->check(words(kMatchings))
      ->type_name("HOW")
      ->group(group);
  command.add_option("--max-difference", match.max_difference_s, "by stamp: at most this far apart (0.02)")
      ->check(positive())
      ->type_name("SECONDS")
      ->group(group);
  command
      .add_flag(
          "--interpolate", match.interpolates_truth,
          "by stamp: interpolate the truth to the estimate's stamps; a truth of twice the rate always is")
      ->group(group);
  command.add_option("--time-offset", match.time_offset_s, "by stamp: added to the estimate's stamps")
      ->type_name("SECONDS")
      ->group(group);
  command
      .add_option("--truth-times", options.truth_times,
                  "stamps for KITTI rows of the truth: a time in seconds per line")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--estimate-times", options.estimate_times, "the same for KITTI rows of the estimate")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--truth-at", options.truth_at,
                  "by row: at which instant of its sweep the truth holds: start, mid, end")
      ->check(words(kInstants))
      ->type_name("INSTANT")
      ->group(group);
  command
      .add_option("--estimate-at", options.estimate_at,
                  "the same of the estimate; default: what its run.json says")
      ->check(words(kInstants))
      ->type_name("INSTANT")
      ->group(group);
}

void add_frame_options(CLI::App& command, EvaluateOptions& options) {
  const char* const group = "Whose poses they are";
  command.add_option("--truth-frame", options.truth_frame, "whose poses the truth holds: sensor, camera")
      ->check(words(kFrames))
      ->type_name("FRAME")
      ->group(group);
  command
      .add_option("--estimate-frame", options.estimate_frame,
                  "whose poses the estimate holds: sensor, camera")
      ->check(words(kFrames))
      ->type_name("FRAME")
      ->group(group);
  command
      .add_option("--camera-calibration", options.camera_calibration,
                  "KITTI's calib.txt, to convert camera poses")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--truth-mount", options.truth_mount,
                  "the truth is of a body that carries the sensor here: metres and degrees")
      ->delimiter(',')
      ->expected(6)
      ->type_name("X,Y,Z,ROLL,PITCH,YAW")
      ->group(group);
  command.add_option("--poses", options.poses, "poses of a results folder: refined, first, front_end")
      ->check(words(kPoses))
      ->type_name("WHICH")
      ->group(group);
}

void add_metric_options(CLI::App& command, EvaluateOptions& options) {
  const char* const group = "What is measured";
  auto& segments = options.evaluation.segments;
  command.add_option("--lengths", segments.lengths_m, "KITTI: segment lengths in metres (100,200,...,800)")
      ->delimiter(',')
      ->check(positive())
      ->type_name("M,M,...")
      ->group(group);
  command.add_option("--step", segments.step_rows, "KITTI: a segment starts at every so many rows (10)")
      ->check(positive())
      ->type_name("ROWS")
      ->group(group);
  command
      .add_option("--parts", options.evaluation.sub_trajectories.parts,
                  "rpg: lengths as parts of the path (0.1,0.2,0.3,0.4,0.5)")
      ->delimiter(',')
      ->type_name("P,P,...")
      ->group(group);
  auto& pairs = options.evaluation.pairs;
  command.add_option("--delta", pairs.delta, "evo: how far the poses of a pair are apart (100)")
      ->check(positive())
      ->type_name("NUMBER")
      ->group(group);
  command.add_option("--delta-unit", options.pair_unit, "evo: m, rows")
      ->check(words(kUnits))
      ->type_name("UNIT")
      ->group(group);
  command.add_flag("--all-pairs", pairs.all_pairs, "evo: a pair from every pose")->group(group);
  command
      .add_flag("--pairs-from-truth", pairs.pairs_from_truth,
                "evo: measure delta along the truth, not along the estimate")
      ->group(group);
  command.add_option("--align", options.align, "for plots: se3, yaw, first, none")
      ->check(words(kAlignments))
      ->type_name("HOW")
      ->group(group);
}

Eigen::Isometry3d mount_of(const std::vector<double>& numbers) {
  constexpr double kRadPerDeg = 0.017453292519943295;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  T.linear() = rotation({numbers[3] * kRadPerDeg, numbers[4] * kRadPerDeg, numbers[5] * kRadPerDeg});
  return T;
}

evaluation::EvaluationOptions common_options(const EvaluateOptions& options) {
  evaluation::EvaluationOptions how = options.evaluation;
  how.match.matching = kMatchings.at(options.match);
  how.truth_frame = kFrames.at(options.truth_frame);
  how.estimate_frame = kFrames.at(options.estimate_frame);
  how.alignment = kAlignments.at(options.align);
  how.pairs.unit = kUnits.at(options.pair_unit);
  if (!options.rows.empty()) how.match.rows = evaluation::parse_row_range(options.rows);
  if (!options.camera_calibration.empty())
    how.T_camera_sensor = evaluation::read_kitti_calibration(options.camera_calibration);
  if (!options.truth_mount.empty()) how.T_truth_sensor = mount_of(options.truth_mount);
  return how;
}

/// In rows: half a sweep is half a row.
double rows_of(PoseInstant instant) {
  return 0.5 * static_cast<double>(instant);
}

double instant_shift(const EvaluateOptions& options, const Estimate& estimate) {
  if (options.truth_at.empty() && options.estimate_at.empty()) return 0.0;
  const std::optional<PoseInstant> at =
      options.estimate_at.empty() ? pose_instant_of(estimate) : kInstants.at(options.estimate_at);
  if (options.truth_at.empty() || !at)
    throw Error(options.truth_at.empty() ? options.truth : estimate.trajectory.name,
                "is not said to hold for the start, the middle or the end of each sweep",
                "give both --truth-at and --estimate-at");
  return rows_of(*at) - rows_of(kInstants.at(options.truth_at));
}

evaluation::Trajectory load_truth(const EvaluateOptions& options) {
  evaluation::Trajectory truth = evaluation::read_trajectory(options.truth);
  if (!options.truth_times.empty()) evaluation::attach_times(truth, options.truth_times);
  return truth;
}

void print(const std::vector<evaluation::Evaluation>& scores, bool as_json) {
  if (scores.size() == 1) {
    std::cout << (as_json ? evaluation_json(scores[0]) : evaluation_report(scores[0]));
  } else {
    std::cout << (as_json ? evaluations_json(scores) : comparison_report(scores));
  }
}

int evaluate_command(const EvaluateOptions& options) {
  const evaluation::Trajectory truth = load_truth(options);
  evaluation::EvaluationOptions how = common_options(options);
  const bool with_stamps = truth.has_stamps() && how.match.matching != Matching::kRow;
  const std::vector<std::string> names = report::short_names(options.estimates);
  std::vector<evaluation::Evaluation> scores;
  report::EvaluationPage page;
  for (std::size_t i = 0; i < options.estimates.size(); ++i) {
    const Estimate estimate =
        load_estimate(options.estimates[i], kPoses.at(options.poses), with_stamps, options.estimate_times);
    how.match.instant_shift_rows = instant_shift(options, estimate);
    scores.push_back(evaluation::evaluate(truth, estimate.trajectory, how));
    page.scored.push_back({names[i], scores.back()});
    page.timed.push_back({names[i], estimate.run.value_or(output::RunFiles{})});
  }
  print(scores, options.json);
  if (!options.html.empty()) {
    if (!options.ground.empty()) page.ground = evaluation::read_ground_folder(options.ground);
    page.made_by = "pago " PAGO_VERSION " evaluate " + options.truth;
    for (const std::string& estimate : options.estimates) page.made_by += " " + estimate;
    output::write_file(options.html, report::evaluation_page(page));
  }
  return 0;
}

}  // namespace

void add_evaluate_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("evaluate", "score trajectories against the truth");
  const auto options = std::make_shared<EvaluateOptions>();
  command.add_option("truth", options->truth, "true poses: KITTI rows or TUM")
      ->type_name("TRUTH")
      ->required();
  command
      .add_option("estimate", options->estimates,
                  "estimated poses: files, or results folders of pago run; several are compared")
      ->type_name("ESTIMATE...")
      ->required();
  command.add_flag("--json", options->json, "print one JSON object");
  CLI::Option* const html =
      command
          .add_option("--html", options->html, "write a page with figures: one file, opens without network")
          ->type_name("FILE");
  command
      .add_option("--ground", options->ground,
                  "a folder of `pago segment`, run on the same drive with labels: its precision and recall "
                  "on the page")
      ->type_name("DIR")
      ->needs(html);
  add_matching_options(command, *options);
  add_frame_options(command, *options);
  add_metric_options(command, *options);
  command.callback([&action, options] { action = [options] { return evaluate_command(*options); }; });
}

}  // namespace pago::app
