// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "buildings.hpp"
#include "models.hpp"
#include "world.hpp"

/// What builders of items share.
namespace pago::simulator {

const Model& one_of(const std::vector<Model>& models, Random& random);

/// Standing upright, turned by `yaw_rad`.
Eigen::Isometry3d upright(const Eigen::Vector2d& at, double z_m, double yaw_rad);
double heading(const Eigen::Vector2d& along);

/// The plot whose front's middle the item marks, without the ground's height.
Plot plot_of(const Item& item);
/// The lowest ground along a plot's front and back.
double lowest(const Ground& ground, const Plot& plot, double depth_m);

}  // namespace pago::simulator
