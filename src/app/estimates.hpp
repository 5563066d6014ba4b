// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pago/config/odometry.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/output/run_files.hpp"

namespace pago::app {

/// What an argument of `pago evaluate` stands for.
struct Estimate {
  evaluation::Trajectory trajectory;    ///< with covariances where the run reported them
  std::optional<output::RunFiles> run;  ///< where the trajectory lies in the results folder of a run
};

/// A trajectory file, or a folder of `pago run` or `pago baseline`: then its trajectory NAME, with stamps
/// (.tum) or as rows (.kitti). What lies beside a trajectory of a results folder comes along: run.json,
/// latency.csv, poses.csv. Rows without stamps get those of a times file, if one is named.
Estimate load_estimate(const std::string& argument,
                       const std::string& name,
                       bool with_stamps,
                       const std::filesystem::path& times_file = {});

/// The instant that a run's poses hold for, by its settings; nothing when it left none.
std::optional<PoseInstant> pose_instant_of(const Estimate& estimate);

}  // namespace pago::app
