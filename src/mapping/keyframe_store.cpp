// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_store.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "pago/registration/voxel_means.hpp"

namespace pago::mapping {

namespace {

std::vector<Eigen::Vector3f> moved(const Eigen::Isometry3d& T, const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> out;
  out.reserve(points.size());
  for (const Eigen::Vector3f& p : points) out.push_back((T * p.cast<double>()).cast<float>());
  return out;
}

}  // namespace

void KeyframeStore::add(const Eigen::Isometry3d& T_map_sensor, const FeatureClouds& clouds) {
  frames_.push_back(
      {T_map_sensor.translation(), {moved(T_map_sensor, clouds.edges), moved(T_map_sensor, clouds.planars)}});
}

std::vector<std::size_t> KeyframeStore::around(const Eigen::Vector3d& place) const {
  using Voxel = std::array<long, 3>;
  std::map<Voxel, std::pair<std::size_t, std::size_t>> voxels;  // sum of indices, how many
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Eigen::Vector3d& at = frames_[i].position;
    if ((at - place).norm() > config_.radius_m) continue;
    if (config_.thinning_m <= 0.0) {
      chosen.push_back(i);
      continue;
    }
    const auto cell = [&](double x) { return static_cast<long>(std::floor(x / config_.thinning_m)); };
    auto& [sum, count] = voxels[{cell(at.x()), cell(at.y()), cell(at.z())}];
    sum += i, ++count;
  }
  for (const auto& [voxel, indices] : voxels) chosen.push_back(indices.first / indices.second);
  return chosen;
}

FeatureClouds KeyframeStore::map_around(const Eigen::Vector3d& place) const {
  FeatureClouds all, thinned;
  for (const std::size_t i : around(place)) {
    const FeatureClouds& frame = frames_[i].in_map;
    all.edges.insert(all.edges.end(), frame.edges.begin(), frame.edges.end());
    all.planars.insert(all.planars.end(), frame.planars.begin(), frame.planars.end());
  }
  registration::voxel_means(all.edges, config_.edge_voxel_m, thinned.edges);
  registration::voxel_means(all.planars, config_.planar_voxel_m, thinned.planars);
  return thinned;
}

}  // namespace pago::mapping
