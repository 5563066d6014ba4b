// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace pago::registration {

/// Appends to `out` the mean of the points of each cubic voxel of side `voxel_m` (the grid through the
/// origin), in the order of the voxels; 0: the points as they are. Points that are not finite, or beyond a
/// million voxels, are left out. The thinning of LeGO-LOAM and PaGO-LOAM (PCL's VoxelGrid). Allocates;
/// deterministic. [one thread]
void voxel_means(std::span<const Eigen::Vector3f> points, double voxel_m, std::vector<Eigen::Vector3f>& out);

}  // namespace pago::registration
