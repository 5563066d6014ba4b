// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/voxel_means.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pago::registration {

namespace {

constexpr float kHalf = 1 << 20;  // voxels: 21 bits for each axis

std::uint64_t key_of(const Eigen::Vector3f& in_voxels) noexcept {
  const auto bits = [](float x) { return static_cast<std::uint64_t>(std::floor(x) + kHalf); };
  return bits(in_voxels.z()) << 42 | bits(in_voxels.y()) << 21 | bits(in_voxels.x());
}

}  // namespace

void voxel_means(std::span<const Eigen::Vector3f> points, double voxel_m, std::vector<Eigen::Vector3f>& out) {
  if (voxel_m <= 0.0) {
    out.insert(out.end(), points.begin(), points.end());
    return;
  }
  const auto per_voxel = static_cast<float>(1.0 / voxel_m);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f in_voxels = points[i] * per_voxel;
    if (in_voxels.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() < kHalf)
      order.emplace_back(key_of(in_voxels), i);
  }
  std::ranges::sort(order);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (; end < order.size() && order[end].first == order[begin].first; ++end)
      sum += points[order[end].second].cast<double>();
    out.push_back((sum / static_cast<double>(end - begin)).cast<float>());
  }
}

}  // namespace pago::registration
