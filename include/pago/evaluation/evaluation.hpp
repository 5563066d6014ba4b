// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pago/evaluation/absolute_error.hpp"
#include "pago/evaluation/association.hpp"
#include "pago/evaluation/consistency.hpp"
#include "pago/evaluation/course.hpp"
#include "pago/evaluation/mix_ups.hpp"
#include "pago/evaluation/motion.hpp"
#include "pago/evaluation/pair_errors.hpp"
#include "pago/evaluation/relative_error.hpp"
#include "pago/evaluation/sub_trajectories.hpp"
#include "pago/evaluation/trajectory.hpp"

/// The quality of an estimated trajectory against the true one: read both (trajectory.hpp), evaluate(), print
/// evaluation_report() or evaluation_json(). Everything here is [set-up]: it allocates, and throws Error for
/// input that cannot be scored.
namespace pago::evaluation {

/// Whose poses a file holds. KITTI's ground truth is the left camera's.
enum class PoseFrame { kSensor, kCamera };

struct EvaluationOptions {
  MatchOptions match;
  SegmentOptions segments;
  SubTrajectoryOptions sub_trajectories;
  PairOptions pairs;
  Alignment alignment = Alignment::kSe3;  ///< of the course
  PoseFrame truth_frame = PoseFrame::kSensor, estimate_frame = PoseFrame::kSensor;
  /// Converts poses of the camera. Needed when one file holds the camera's poses and the other the sensor's;
  /// two camera files are compared at the camera when it is missing.
  std::optional<Eigen::Isometry3d> T_camera_sensor = std::nullopt;
  /// The truth holds poses of a body (base_link, an inertial unit) that the sensor is mounted on like this.
  std::optional<Eigen::Isometry3d> T_truth_sensor = std::nullopt;
};

/// Where the estimate ends when both start together: motion of the estimate minus that of the truth.
struct FinalDrift {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< x y z in the first pose's frame
  double distance_m = 0.0;
  double percent = 0.0;  ///< of the true path's length; NaN when that is zero
  double rotation_rad = 0.0;
};

struct Evaluation {
  std::string truth_name, estimate_name;
  std::size_t truth_poses = 0, estimate_poses = 0;  ///< in the files
  std::size_t num_rows = 0, num_matched = 0;  ///< rows of the base that were scored, and with an estimate
  std::string how;                            ///< they were matched, e.g. "by row"
  std::vector<double> lengths_m;              ///< asked for
  int step_rows = 0;
  Motion truth_motion, estimate_motion;               ///< over the matched rows
  RelativeErrors relative;                            ///< KITTI devkit
  std::vector<SubTrajectoryErrors> sub_trajectories;  ///< rpg_trajectory_evaluation
  PairOptions pair_options;
  PairErrors pairs;                                                                  ///< evo
  std::array<AbsoluteErrors, static_cast<std::size_t>(Alignment::kCount)> absolute;  ///< by Alignment
  FinalDrift final_drift;
  std::optional<Consistency> consistency;  ///< where the estimate has covariances
  std::vector<CoursePoint> course;
  Alignment course_alignment = Alignment::kSe3;
  std::vector<MixUp> mix_ups;
  std::vector<std::string> warnings;  ///< whole sentences, those of the mix-ups among them

  const AbsoluteErrors& ate(Alignment alignment) const noexcept {
    return absolute[static_cast<std::size_t>(alignment)];
  }
};

Evaluation evaluate(Trajectory truth, Trajectory estimate, const EvaluationOptions& options = {});

/// A table for the terminal, ends with a line feed. Rotation rates are in degrees per 100 m throughout.
std::string evaluation_report(const Evaluation& evaluation);

/// The same figures as a JSON object; keys carry the units. Undefined figures are null. Several evaluations
/// become the list "evaluations".
std::string evaluation_json(const Evaluation& evaluation);
std::string evaluations_json(const std::vector<Evaluation>& evaluations);

}  // namespace pago::evaluation
