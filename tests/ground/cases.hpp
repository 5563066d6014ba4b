// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "pago/ground/segmenter.hpp"
#include "support/scene.hpp"

namespace pago::test {

inline constexpr std::uint32_t kMaxReturns = 140'000;
inline constexpr ScanOptions kNoisy{
    .mount = {}, .columns = 2083, .noise_m = 0.01, .seed = 5, .max_range_m = 120.0};

/// What a method can be expected to see in simple worlds. The defaults are what a good one does; who falls
/// short by its very idea says so in ground_cases().
struct Ability {
  double min_recall = 0.9;  ///< of ground within 20 m: level, beside a kerb, a wall, a car
  double max_ramp = 0.2;    ///< steepest rise ahead that it follows
  double min_ramp_recall = 0.9;
  double min_fall_recall = 0.9;  ///< of ground that falls away ahead by 5 %
  double max_wall = 0.01;        ///< part of a wall's upper returns that it takes for ground
  double max_bridge = 0.01;      ///< the same of a bridge overhead
  double min_below_bridge = 0.9;
  double max_roof = 0.01;  ///< the same of a near car's roof
  double min_tilted_recall = 0.9;
  bool finds_ground = true;
};

/// A method with settings that make it another one.
struct GroundCase {
  std::string name;
  GroundConfig config;
  Ability can;
};

/// By name as in the table.
inline Ability ability_of(std::string_view method) {
  Ability can;
  if (method == "lego") can = {.max_ramp = 0.15, .max_roof = 1.0};  // 10 degrees; knows no height
  if (method == "rgpf") can = {.max_wall = 0.3, .max_bridge = 0.2, .max_roof = 1.0};  // judges no plane
  // Lines end where no ground is seen before the bridge.
  if (method == "linefit") can = {.min_fall_recall = 0.8, .min_below_bridge = 0.25};
  if (method == "ransac" || method == "gpf") can = {.max_ramp = 0.0};  // one plane
  // Chains of rings on more are obstacles. Planes are thin and end at bounds of their own; beams are told
  // apart by angle, which a tilted sensor's are not.
  if (method == "cascaded") can = {.max_ramp = 0.15, .min_fall_recall = 0.4, .min_tilted_recall = 0.7};
  if (method == "truth-errors")
    can = {.min_recall = 0.88,
           .min_ramp_recall = 0.88,
           .min_fall_recall = 0.88,
           .max_wall = 0.03,
           .max_bridge = 0.03,
           .max_roof = 0.03,
           .min_tilted_recall = 0.88};
  if (method == "none") can = {.min_recall = 0.0, .finds_ground = false};
  return can;
}

/// Every row of the table, and every variant that takes another path through the code.
inline std::vector<GroundCase> ground_cases() {
  std::vector<GroundCase> cases;
  for (const ground::Method& method : ground::methods()) {
    GroundConfig config;
    config.method = method.name;
    cases.push_back({.name = config.method, .config = config, .can = ability_of(method.name)});
  }
  GroundConfig lego;
  lego.method = "lego";
  lego.lego.projection = LegoConfig::Projection::kUniform;
  // LeGO-LOAM's own grid loses what lies below an empty pixel.
  cases.push_back({"lego (uniform)",
                   lego,
                   {.min_recall = 0.8,
                    .max_ramp = 0.15,
                    .min_ramp_recall = 0.65,
                    .max_roof = 1.0,
                    .min_tilted_recall = 0.4}});
  GroundConfig gpf;
  gpf.method = "gpf";
  gpf.gpf.planes = GpfConfig::Planes::kSlabs;
  cases.push_back({"gpf (slabs)", gpf, {.max_ramp = 0.0}});
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
