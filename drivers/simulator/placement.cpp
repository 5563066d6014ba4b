// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "placement.hpp"

#include <algorithm>
#include <cmath>

namespace pago::simulator {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Model& one_of(const std::vector<Model>& models, Random& random) {
  return models[static_cast<std::size_t>(random.below(static_cast<int>(models.size())))];
}

Eigen::Isometry3d upright(const Vector2d& at, double z_m, double yaw_rad) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << at, z_m;
  return T;
}

double heading(const Vector2d& along) {
  return std::atan2(along.y(), along.x());
}

Plot plot_of(const Item& item) {
  Plot plot;
  plot.along = item.along;
  plot.inward = item.side * Vector2d(-item.along.y(), item.along.x());
  plot.width_m = item.width_m;
  plot.corner = item.at - 0.5 * item.width_m * item.along;
  return plot;
}

double lowest(const Ground& ground, const Plot& plot, double depth_m) {
  double low = ground.height_m(plot.corner);
  for (const double right : {0.0, 0.5, 1.0}) {
    for (const double in_m : {0.0, depth_m}) {
      const Vector2d at = plot.corner + right * plot.width_m * plot.along + in_m * plot.inward;
      low = std::min(low, ground.height_m(at));
    }
  }
  return low;
}

}  // namespace pago::simulator
