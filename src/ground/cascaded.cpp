// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// CascadedSeg: Narksri et al., "A slope-robust cascaded ground segmentation in 3D point cloud for autonomous
// vehicles", ITSC 2018. Parameters and their sources in config/ground/cascaded.hpp.
//
//   chains   rings that are nearer to each other than on the ground: obstacles     (ring_chains.hpp)
//   regions  what is left in four quadrants and up to four rings of sections
//   planes   RANSAC in each region, from the inside out; a plane that does not continue the one before is
//            replaced by it
//
// Differs from the authors' code: ring spacings are those of the rings (there the table is read upside down,
// the widest for the lowest rings); the lower beams begin at 8.83 degrees in the section bounds too
// (there 9.83); planes are compared where the sections meet (there at the farther bound); a quadrant that has
// no plane yet does not take everything for ground; returns are levelled by the mount first.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "bin_sort.hpp"
#include "methods.hpp"
#include "pago/core/units.hpp"
#include "random.hpp"
#include "ransac_plane.hpp"
#include "ring_chains.hpp"

namespace pago::ground {
namespace {

class Cascaded final : public Segmenter {
 public:
  Cascaded(const CascadedConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        rule_{.inlier_distance_m = config.inlier_distance_m,
              .max_iterations = config.max_iterations,
              .confidence = config.confidence,
              .min_uprightness = 0.0},
        level_(mount, max_returns),
        chains_(config, max_returns),
        regions_(kRegions, max_returns) {
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override {
    chains_.set_height(height_m);
    set_bounds(height_m);
  }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = level_(sweep, 0, sweep.size);
    chains_.find_candidates(returns, sweep.size, sweep.ground.data());
    divide(returns, sweep);
    for (int quadrant = 0; quadrant < kQuadrants; ++quadrant) fit(quadrant);
    label(returns, sweep);
  }

 private:
  static constexpr int kQuadrants = 4, kSections = 4, kRegions = kQuadrants * kSections;
  static constexpr Slab kNothing{0.0F, 0.0F, 0.0F, 1.0F, 0.0F};

  /// A section ends where the beam that is so many down hits level ground; the last one has no end.
  void set_bounds(double height_m) noexcept {
    bounds_m_.fill(std::numeric_limits<double>::infinity());
    const int beams = (kNumRings + config_.sections - 1) / config_.sections;
    for (int s = 0; s + 1 < config_.sections; ++s) {
      const double below_rad = beam_below_horizon_deg(kNumRings - beams * (s + 1)) * kDegree;
      bounds_m_[static_cast<std::size_t>(s)] = height_m / std::tan(below_rad);
    }
  }

  /// Quadrants lie ahead, left, behind, right, and meet at 45 degrees.
  void divide(const Coordinates& returns, const Sweep& sweep) noexcept {
    const std::array<double, kSections> bounds_m = bounds_m_;
    const std::uint8_t* const is_candidate = sweep.ground.data();
    const std::uint32_t size = sweep.size;
    regions_.begin();
    std::uint16_t* const region_of = regions_.bin_of();
#pragma omp simd
    for (std::uint32_t i = 0; i < size; ++i) {
      const float x = returns.x_m[i], y = returns.y_m[i];
      const double along = static_cast<double>(x), across = static_cast<double>(y);
      const double range = std::sqrt(along * along + across * across);
      const std::int32_t left = y >= x ? 1 : 0, front = y >= -x ? 1 : 0;
      const std::int32_t quadrant = left != 0 ? 2 - front : 3 - 3 * front;
      const std::int32_t section =
          (range >= bounds_m[0] ? 1 : 0) + (range >= bounds_m[1] ? 1 : 0) + (range >= bounds_m[2] ? 1 : 0);
      const std::int32_t region = quadrant * kSections + section;
      region_of[i] = static_cast<std::uint16_t>(is_candidate[i] != 0 ? region : kRegions);
    }
    regions_.note(size);
    regions_.sort_rest(returns);
  }

  void fit(int quadrant) noexcept {
    PlaneFit before;  // no plane yet
    for (int section = 0; section < config_.sections; ++section) {
      const int region = quadrant * kSections + section;
      const Points points = regions_.points(region);
      constexpr std::size_t kTooFew = 3;
      PlaneFit plane;
      if (points.size() > kTooFew)
        plane = ransac_plane(
            points, rule_,
            scramble(static_cast<std::uint64_t>(config_.seed)) + static_cast<std::uint64_t>(region));
      if (!plane.is_valid || !continues(before, plane, quadrant, section)) plane = before;
      ground_[static_cast<std::size_t>(region)] =
          plane.is_valid ? plane.around(config_.inlier_distance_m) : kNothing;
      before = plane;
    }
  }

  bool continues(const PlaneFit& before, const PlaneFit& plane, int quadrant, int section) const noexcept {
    if (!before.is_valid) return true;
    const double azimuth = quadrant * std::numbers::pi / 2.0;
    const double border_m = bounds_m_[static_cast<std::size_t>(section) - 1];
    const Eigen::Vector2d meeting(border_m * std::cos(azimuth), border_m * std::sin(azimuth));
    const double step_m = std::abs(plane.height_at(meeting) - before.height_at(meeting));
    const double min_cosine = std::cos(config_.max_angle_deg * kDegree);
    return step_m <= config_.max_height_step_m && plane.normal.dot(before.normal) >= min_cosine;
  }

  void label(const Coordinates& returns, Sweep& sweep) const noexcept {
    const std::uint16_t* const region_of = regions_.bin_of();
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const bool is_ground = ground_[region_of[i]].holds(returns.x_m[i], returns.y_m[i], returns.z_m[i]);
      sweep.ground[i] = is_ground ? kGround : kNonGround;
    }
  }

  CascadedConfig config_;
  RansacRule rule_;
  Leveller level_;
  RingChains chains_;
  BinSort regions_;
  std::array<double, kSections> bounds_m_{};  // where sections end
  std::array<Slab, kRegions + 1> ground_{};   // per region, and nothing for the rest
};

}  // namespace

std::unique_ptr<Segmenter> make_cascaded(const GroundConfig& config,
                                         const Mount& mount,
                                         std::uint32_t max_returns) {
  return std::make_unique<Cascaded>(config.cascaded, mount, max_returns);
}

}  // namespace pago::ground
