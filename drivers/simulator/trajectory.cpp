// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/trajectory.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pago/core/se3.hpp"

namespace pago::simulator {

Trajectory::Trajectory(std::span<const Eigen::Isometry3d> T_world_body, double interval_s)
    : interval_s_(interval_s), duration_s_(interval_s * static_cast<double>(T_world_body.size() - 1)) {
  assert(T_world_body.size() >= 2);
  // A pose beyond either end, so that the motion goes on there as it does before.
  const auto beyond = [](const Eigen::Isometry3d& end, const Eigen::Isometry3d& inner) {
    Eigen::Isometry3d T = end;
    T.linear() = end.linear() * inner.linear().transpose() * end.linear();
    T.translation() = 2.0 * end.translation() - inner.translation();
    return T;
  };
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(T_world_body.size() + 2);
  poses.push_back(beyond(T_world_body[0], T_world_body[1]));
  poses.insert(poses.end(), T_world_body.begin(), T_world_body.end());
  poses.push_back(beyond(T_world_body.back(), T_world_body[T_world_body.size() - 2]));

  knots_.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    knots_[i].position = poses[i].translation();
    knots_[i].rotation = poses[i].linear();
    if (i == 0) continue;
    knots_[i].step = poses[i].translation() - poses[i - 1].translation();
    knots_[i].turn = log_so3(poses[i - 1].linear().transpose() * poses[i].linear());
  }
}

Eigen::Isometry3d Trajectory::pose(double t_s) const noexcept {
  const double at = std::clamp(t_s, 0.0, duration_s_) / interval_s_;
  const auto i = std::min(static_cast<std::size_t>(at), knots_.size() - 4);
  const double u = at - static_cast<double>(i);
  // The basis functions, summed from the end (eq. 4).
  const double b1 = (5.0 + u * (3.0 - u * (3.0 - u))) / 6.0;
  const double b2 = (1.0 + u * (3.0 + u * (3.0 - 2.0 * u))) / 6.0;
  const double b3 = u * u * u / 6.0;
  const Knot &k0 = knots_[i], &k1 = knots_[i + 1], &k2 = knots_[i + 2], &k3 = knots_[i + 3];
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = k0.position + b1 * k1.step + b2 * k2.step + b3 * k3.step;
  T.linear() = k0.rotation * exp_so3(b1 * k1.turn) * exp_so3(b2 * k2.turn) * exp_so3(b3 * k3.turn);
  return T;
}

}  // namespace pago::simulator
