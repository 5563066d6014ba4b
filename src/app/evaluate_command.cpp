// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "commands.hpp"
#include "pago/evaluation/evaluation.hpp"

namespace pago::app {

namespace {

using evaluation::Matching;
using evaluation::PoseFrame;

struct EvaluateOptions {
  std::string truth, estimate, rows, camera_calibration;
  std::string match = "auto", truth_frame = "sensor", estimate_frame = "sensor";
  evaluation::EvaluationOptions evaluation;
  bool json = false;
};

const std::map<std::string, Matching> kMatchings{
    {"auto", Matching::kAuto}, {"row", Matching::kRow}, {"stamp", Matching::kStamp}};
const std::map<std::string, PoseFrame> kFrames{{"sensor", PoseFrame::kSensor},
                                               {"camera", PoseFrame::kCamera}};

/// The library's own descriptions of these checks would print enum values into the help.
template <typename Words>
CLI::Validator words(const Words& known) {
  return CLI::IsMember(known).description("");
}
CLI::Validator positive() {
  return CLI::Validator(CLI::PositiveNumber).description("");
}

void add_matching_options(CLI::App& command, EvaluateOptions& options) {
  auto& match = options.evaluation.match;
  command.add_option("--rows", options.rows, "score rows A to B only, counted from 0")->type_name("A-B");
  command.add_option("--match", options.match, "how poses belong together: auto, row, stamp")
      ->check(words(kMatchings))
      ->type_name("HOW");
  command.add_option("--max-difference", match.max_difference_s, "by stamp: at most this far apart (0.02)")
      ->check(positive())
      ->type_name("SECONDS");
  command.add_flag("--interpolate", match.interpolates_truth,
                   "by stamp: interpolate the truth to the estimate's stamps");
}

void add_frame_options(CLI::App& command, EvaluateOptions& options) {
  command.add_option("--truth-frame", options.truth_frame, "whose poses the truth holds: sensor, camera")
      ->check(words(kFrames))
      ->type_name("FRAME");
  command
      .add_option("--estimate-frame", options.estimate_frame,
                  "whose poses the estimate holds: sensor, camera")
      ->check(words(kFrames))
      ->type_name("FRAME");
  command
      .add_option("--camera-calibration", options.camera_calibration,
                  "KITTI's calib.txt, to convert camera poses")
      ->type_name("FILE");
}

int evaluate_command(const EvaluateOptions& options) {
  evaluation::EvaluationOptions how = options.evaluation;
  how.match.matching = kMatchings.at(options.match);
  how.truth_frame = kFrames.at(options.truth_frame);
  how.estimate_frame = kFrames.at(options.estimate_frame);
  if (!options.rows.empty()) how.match.rows = evaluation::parse_row_range(options.rows);
  if (!options.camera_calibration.empty()) {
    how.T_camera_sensor = evaluation::read_kitti_calibration(options.camera_calibration);
  }
  const evaluation::Evaluation result = evaluation::evaluate(
      evaluation::read_trajectory(options.truth), evaluation::read_trajectory(options.estimate), how);
  std::cout << (options.json ? evaluation::evaluation_json(result) : evaluation::evaluation_report(result));
  return 0;
}

}  // namespace

void add_evaluate_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("evaluate", "score a trajectory against the truth");
  const auto options = std::make_shared<EvaluateOptions>();
  command.add_option("truth", options->truth, "true poses: KITTI rows or TUM")
      ->type_name("TRUTH")
      ->required();
  command.add_option("estimate", options->estimate, "estimated poses")->type_name("ESTIMATE")->required();
  command.add_flag("--json", options->json, "print one JSON object");
  auto& segments = options->evaluation.segments;
  command.add_option("--lengths", segments.lengths_m, "segment lengths in metres (100,200,...,800)")
      ->delimiter(',')
      ->check(positive())
      ->type_name("M,M,...");
  command.add_option("--step", segments.step_rows, "a segment starts at every so many rows (10)")
      ->check(positive())
      ->type_name("ROWS");
  add_matching_options(command, *options);
  add_frame_options(command, *options);
  command.callback([&action, options] { action = [options] { return evaluate_command(*options); }; });
}

}  // namespace pago::app
