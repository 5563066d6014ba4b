// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "plane_fit.hpp"

namespace pago::ground {

struct RansacRule {
  double inlier_distance_m = 0.1;
  int max_iterations = 100;
  double confidence = 0.99;      ///< trying ends when a better plane has been met with this probability
  double min_uprightness = 0.0;  ///< planes whose normal's z is less are not considered
};

/// The plane that most points lie on, among those through three random ones each, then fitted to these points
/// (as PCL's SACSegmentation with optimised coefficients). The same points and seed give the same plane.
/// [front thread] Real-time safe.
PlaneFit ransac_plane(const Points& points, const RansacRule& rule, std::uint64_t seed) noexcept;

}  // namespace pago::ground
