// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "random.hpp"
#include "surface.hpp"

namespace pago::simulator {

/// A surface is met no flatter than by this cosine: what grows as its inverse stays finite.
inline constexpr double kLeastCosIncidence = 0.08;

/// A surface in a beam.
struct Echo {
  double range_m = 0.0;
  double cos_incidence = 1.0;  ///< of the angle between beam and normal, 0 grazing
  Surface surface;
  double share = 1.0;  ///< of the beam that falls on it
};

/// What the unit makes of it.
struct Return {
  double range_m = 0.0;
  double intensity = 0.0;  ///< 0 to 255, before the calibration's focal correction is undone
  Label label = Label::kUnlabelled;
  bool is_there = false;
};
/// Strongest first; the second is the last in time, or the second strongest where the strongest is the last.
using Returns = std::array<Return, 2>;

struct ReturnModel {
  double range_noise_m = 0.0075;
  double outliers = 0.0;
  double wetness = 0.0;
};

/// How a laser and its receiver differ from their neighbours.
struct LaserOptics {
  double gain = 1.0;
  double always_lost = 0.0;  ///< part of the returns, whatever they come from
};

/// From what lies in one beam (one echo, or two where an edge cuts it) to its returns. Light that comes back
/// weaker than the receiver's threshold is lost, the more surely the weaker it is: grazing, dark, wet and far
/// surfaces drop out. Two echoes closer together than a light pulse is long merge to one between them.
Returns returns_of(const ReturnModel& model,
                   const std::array<Echo, 2>& echoes,
                   std::size_t num_echoes,
                   const LaserOptics& laser,
                   Random& random) noexcept;

}  // namespace pago::simulator
