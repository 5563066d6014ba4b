// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "estimates.hpp"

#include <filesystem>

#include "pago/config/load.hpp"

namespace pago::app {

namespace {

namespace fs = std::filesystem;

/// The covariances are those of the refined poses' motions, so only trajectory.* has them.
void attach_covariances(Estimate& estimate, const fs::path& file) {
  if (file.stem() != "trajectory") return;
  for (const output::PoseFacts& pose : estimate.run->poses)
    estimate.trajectory.motion_covariances.push_back(pose.covariance);
}

}  // namespace

Estimate load_estimate(const std::string& argument,
                       const std::string& name,
                       bool with_stamps,
                       const fs::path& times_file) {
  fs::path file = argument;
  const bool is_folder = fs::is_directory(file);
  Estimate estimate;
  if (is_folder && output::is_results_folder(file)) estimate.run = output::read_run_files(file);
  if (is_folder) file /= name + (with_stamps ? ".tum" : ".kitti");
  estimate.trajectory = evaluation::read_trajectory(file);
  if (!times_file.empty()) evaluation::attach_times(estimate.trajectory, times_file);
  if (is_folder) estimate.trajectory.name = argument;
  if (!estimate.run && output::is_results_folder(file.parent_path()))
    estimate.run = output::read_run_files(file.parent_path());
  if (!estimate.run) return estimate;
  attach_covariances(estimate, file);
  return estimate;
}

std::optional<PoseInstant> pose_instant_of(const Estimate& estimate) {
  if (!estimate.run || estimate.run->facts.config_toml.empty()) return std::nullopt;
  Config settings;
  apply_toml(settings, estimate.run->facts.config_toml, (estimate.run->folder / "run.json").string());
  return settings.odometry.pose_instant;
}

}  // namespace pago::app
