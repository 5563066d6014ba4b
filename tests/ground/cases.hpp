// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "pago/ground/segmenter.hpp"

namespace pago::test {

inline constexpr std::uint32_t kMaxReturns = 140'000;

/// A method with settings that make it another one.
struct GroundCase {
  std::string name;
  GroundConfig config;
  /// Of ground within 30 m that is level or a ramp of 15 %, the share that it finds at least. LeGO-LOAM's own
  /// grid loses what lies below an empty pixel.
  double min_recall = 0.9;
};

/// Every row of the table, and every variant that takes another path through the code.
inline std::vector<GroundCase> ground_cases() {
  std::vector<GroundCase> cases;
  for (const ground::Method& method : ground::methods()) {
    GroundConfig config;
    config.method = method.name;
    cases.push_back({.name = config.method, .config = config});
    if (config.method != "lego") continue;
    config.lego.projection = LegoConfig::Projection::kUniform;
    cases.push_back({.name = "lego (uniform)", .config = config, .min_recall = 0.4});
  }
  return cases;
}

inline void segment(ground::Segmenter& segmenter, Sweep& sweep) {
  segmenter.begin(sweep);
  segmenter.accept({&sweep, sweep.size, sweep.header.num_columns, true});
  segmenter.finish(sweep);
}

inline std::vector<std::uint8_t> mask_of(const Sweep& sweep) {
  return {sweep.ground.data(), sweep.ground.data() + sweep.size};
}

inline std::vector<std::uint8_t> segmented(const GroundConfig& config,
                                           Sweep& sweep,
                                           const Mount& mount = {}) {
  segment(*ground::make_segmenter(config, mount, sweep.capacity()), sweep);
  return mask_of(sweep);
}

inline double range_xy_m(const Sweep& sweep, std::size_t i) {
  return std::hypot(static_cast<double>(sweep.x_m[i]), static_cast<double>(sweep.y_m[i]));
}

/// Share of the returns with `truth` (and for which `where(i)` holds) that the mask calls ground; 0 of none.
template <typename Where>
double share_called_ground(const std::vector<std::uint8_t>& mask,
                           const std::vector<std::uint8_t>& truth,
                           std::uint8_t wanted,
                           const Where& where) {
  double called = 0.0, all = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (truth[i] != wanted || !where(i)) continue;
    all += 1.0;
    called += mask[i] == kGround ? 1.0 : 0.0;
  }
  return all > 0.0 ? called / all : 0.0;
}

}  // namespace pago::test
