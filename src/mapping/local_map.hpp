// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/mapping.hpp"
#include "pago/core/deskew.hpp"
#include "pago/registration/cell_map.hpp"
#include "pago/registration/point_cloud.hpp"

namespace pago::mapping {

registration::CellMapOptions options_of(const CellsConfig& config) noexcept;

/// Adds points, one of every `stride`, de-skewed by `motion`, seen from `T_map_sensor`. Real-time safe.
void insert_points(const registration::PointCloud& points,
                   const MotionInSweep& motion,
                   const Eigen::Isometry3d& T_map_sensor,
                   registration::CellMap& map,
                   std::size_t stride = 1) noexcept;

/// As much as `to` holds.
void copy(const registration::PointCloud& from, registration::PointCloud& to) noexcept;

}  // namespace pago::mapping
