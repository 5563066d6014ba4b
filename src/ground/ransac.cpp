// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// One plane for the sweep by RANSAC (Fischler and Bolles 1981), as the Patchwork authors' ground benchmark
// runs PCL's. Parameters and their sources in config/ground/ransac.hpp.
//
// Differs from that code: the normal points up, which there is left to chance, so that "below the plane" is
// below it; every return is tested, there those after the last inlier are not; planes steeper than
// max_tilt_deg are not considered; returns that are zero or not finite are left out; returns are levelled by
// the mount first.
#include <algorithm>
#include <array>
#include <cmath>

#include "bin_sort.hpp"
#include "label.hpp"
#include "methods.hpp"
#include "pago/core/units.hpp"
#include "ransac_plane.hpp"

namespace pago::ground {
namespace {

class RansacGround final : public Segmenter {
 public:
  RansacGround(const RansacConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        rule_{.inlier_distance_m = config.inlier_distance_m,
              .max_iterations = config.max_iterations,
              .confidence = config.confidence,
              .min_uprightness = std::cos(config.max_tilt_deg * kDegree)},
        level_(mount, max_returns),
        usable_(1, max_returns) {}

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = level_(sweep, 0, sweep.size);
    gather(returns, sweep.size);
    const PlaneFit plane = ransac_plane(usable_.points(0), rule_, static_cast<std::uint64_t>(config_.seed));
    const double thickness_m = std::max(config_.ground_thickness_m, config_.inlier_distance_m);
    const std::array<HalfSpace, 2> ground{plane.is_valid ? plane.below(thickness_m) : HalfSpace::nothing(),
                                          HalfSpace::nothing()};
    label_by_bin(returns, usable_.bin_of(), ground.data(), sweep);
  }

 private:
  void gather(const Coordinates& returns, std::uint32_t size) noexcept {
    usable_.begin();
    std::uint16_t* const bin_of = usable_.bin_of();
#pragma omp simd
    for (std::uint32_t i = 0; i < size; ++i)
      bin_of[i] = is_return(returns.x_m[i], returns.y_m[i], returns.z_m[i]) ? 0 : 1;
    usable_.note(size);
    usable_.sort_rest(returns);
  }

  RansacConfig config_;
  RansacRule rule_;
  Leveller level_;
  BinSort usable_;
};

}  // namespace

std::unique_ptr<Segmenter> make_ransac(const GroundConfig& config,
                                       const Mount& mount,
                                       std::uint32_t max_returns) {
  return std::make_unique<RansacGround>(config.ransac, mount, max_returns);
}

}  // namespace pago::ground
