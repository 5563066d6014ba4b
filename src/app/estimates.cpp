// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "estimates.hpp"

#include <filesystem>

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

Estimate load_estimate(const std::string& argument, const std::string& name, bool with_stamps) {
  fs::path file = argument;
  const bool is_folder = fs::is_directory(file);
  Estimate estimate;
  if (is_folder && output::is_results_folder(file)) estimate.run = output::read_run_files(file);
  if (is_folder) file /= name + (with_stamps ? ".tum" : ".kitti");
  estimate.trajectory = evaluation::read_trajectory(file);
  if (is_folder) estimate.trajectory.name = argument;
  if (!estimate.run && output::is_results_folder(file.parent_path()))
    estimate.run = output::read_run_files(file.parent_path());
  if (!estimate.run) return estimate;
  attach_covariances(estimate, file);
  return estimate;
}

std::string pose_instant_of(const Estimate& estimate) {
  if (!estimate.run) return {};
  const std::string& settings = estimate.run->facts.config_toml;
  const std::string key = "pose_instant = \"";
  const std::size_t at = settings.find(key);
  if (at == std::string::npos) return {};
  const std::size_t start = at + key.size();
  return settings.substr(start, settings.find('"', start) - start);
}

}  // namespace pago::app
