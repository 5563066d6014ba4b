// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "pago/registration/rows.hpp"

namespace pago::registration {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Matrix6x12d = Eigen::Matrix<double, 6, 12>;

/// What the rows say of the motion within a sweep, apart from the motion since the last one. A point that was
/// seen `s` after the reference instant is moved by a motion d of the sweep, by a change v of its velocity
/// and by a change a of its acceleration as by the one motion d + s v + s^2 / 2 a, so that sums of s^k w J
/// J^T are all that is needed. The unknowns v and a stand together: their velocity first.
struct BendEquations {
  Matrix6x12d motion_bend = Matrix6x12d::Zero();
  Matrix12d bend_bend = Matrix12d::Zero();
  Vector12d b = Vector12d::Zero();
};

/// Normal equations of rows by the time that their points were seen at, in bins of a 256th of a second: one
/// pass over the rows serves the motion and the motion within. Beyond 1/8 s to either side of the reference
/// instant (sweeps at less than 4 Hz) all is in the outermost bin, at its own mean time. Real-time safe.
class TimedEquations {
 public:
  void clear() noexcept;
  void add(const Row& row, float before_s) noexcept;

  NormalEquations sum() const noexcept;
  BendEquations bends() const noexcept;

 private:
  static constexpr int kBins = 64;
  struct Bin {
    NormalEquations equations;
    double weighted_after_s = 0.0;
  };
  std::array<Bin, kBins> bins_;
};

}  // namespace pago::registration
