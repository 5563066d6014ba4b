// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace pago::ground {

/// atan(t) / (2 pi) for t in [0, 1]. Odd minimax polynomial of degree 15 (own Remez exchange): off by 6e-9
/// turns; float arithmetic makes it 5e-8 (3e-7 rad).
inline float atan_turns(float t) noexcept {
  constexpr std::array<float, 8> kC{0.15915484F,  -0.05304612F,  0.031745944F, -0.022136271F,
                                    0.015346034F, -0.008898723F, 0.003479598F, -0.00064530445F};
  const float u = t * t;
  const float low = kC[0] + u * (kC[1] + u * (kC[2] + u * kC[3]));
  const float high = kC[4] + u * (kC[5] + u * (kC[6] + u * kC[7]));
  return t * (low + u * u * (u * u) * high);
}

/// atan2(y, x) / (2 pi), in [-0.5, 0.5]; (0, 0) gives 0. No branches: loops around it vectorise.
inline float atan2_turns(float y, float x) noexcept {
  constexpr float kTiny = std::numeric_limits<float>::min();
  const float across = std::fabs(y);
  const float along = std::fabs(x);
  const float shorter = across < along ? across : along;
  const float longer = across < along ? along : across;
  float turns = atan_turns(shorter / (longer > kTiny ? longer : kTiny));
  turns = across > along ? 0.25F - turns : turns;
  turns = x < 0.0F ? 0.5F - turns : turns;
  return y < 0.0F ? -turns : turns;
}

}  // namespace pago::ground
