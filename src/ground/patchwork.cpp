// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Lim, Oh and Myung, "Patchwork", RA-L 2021; parameters and their sources in config/ground.hpp.
//
//   locate   every return's bin in the concentric zone model          (Sec. III-B)
//   group    returns of a bin side by side
//   fit      region-wise ground plane fitting, R-GPF                  (Sec. III-C)
//   judge    ground likelihood estimation: upright, low or flat       (Sec. III-D)
//   label    below the bin's plane = ground, in the sweep's own order
//
// Differs from the authors' code: normals point up, which there is left to chance (a downward one turns the
// half-space over); bins of few points are non-ground; returns are levelled by the mount first.
#include <cmath>
#include <limits>

#include "lowest_mean.hpp"
#include "methods.hpp"
#include "pago/core/error.hpp"
#include "plane_fit.hpp"

namespace pago::ground {
namespace {

constexpr int kInnerRings = 4;  // rings with a bound on elevation of their own

int whole_number(const char* key, double value) {
  if (value == std::floor(value)) return static_cast<int>(value);
  throw Error(key, "must be whole numbers, has " + std::to_string(value));
}

PolarGrid concentric_zones(const PatchworkConfig& c) {
  const double near = c.min_range_m, far = c.max_range_m;
  if (!(near < far)) throw Error("ground.patchwork.max_range_m", "must be greater than min_range_m");
  const std::array<double, 4> lower_m{near, (7.0 * near + far) / 8.0, (3.0 * near + far) / 4.0,
                                      (near + far) / 2.0};
  std::array<PolarZone, 4> zones;
  for (std::size_t i = 0; i < zones.size(); ++i)
    zones[i] = {lower_m[i], whole_number("ground.patchwork.zone_rings", c.zone_rings[i]),
                whole_number("ground.patchwork.zone_sectors", c.zone_sectors[i])};
  return PolarGrid(zones, far);
}

class Patchwork final : public Segmenter {
 public:
  Patchwork(const PatchworkConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        height_m_(mount.height_m),
        min_z_m_(static_cast<float>(-mount.height_m - config.low_cut_below_ground_m)),
        level_(mount, max_returns),
        bins_(concentric_zones(config), max_returns),
        lowest_mean_(max_returns),
        ground_of_bin_(static_cast<std::size_t>(bins_.grid().num_bins()) + 1, kNothing) {}

  void begin(Sweep&) noexcept override { bins_.clear(); }
  void accept(const SweepPart& part) noexcept override { locate(*part.sweep, part.returns_until); }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = locate(sweep, sweep.size);
    bins_.group(returns);
    for (int bin = 0; bin < bins_.grid().num_bins(); ++bin)
      ground_of_bin_[static_cast<std::size_t>(bin)] = ground_in(bin);
    label(returns, sweep);
  }

 private:
  static constexpr HalfSpace kNothing{0.0F, 0.0F, 0.0F, -std::numeric_limits<float>::infinity()};

  Coordinates locate(const Sweep& sweep, std::uint32_t until) noexcept {
    const Coordinates returns = level_(sweep, bins_.located(), until);
    bins_.locate(returns, until, min_z_m_);
    return returns;
  }

  HalfSpace ground_in(int bin) noexcept {
    const BinPoints points = bins_.points(bin);
    if (points.size() <= static_cast<std::size_t>(config_.min_points)) return kNothing;
    const PolarCell& cell = bins_.grid().cell(bin);
    const PlaneFit plane = fit(points, cell);
    return is_ground(plane, cell) ? plane.below(config_.ground_thickness_m) : kNothing;
  }

  /// R-GPF. The low returns that are passed over as mirror images still belong to the seeds, as in the
  /// authors' code.
  PlaneFit fit(const BinPoints& points, const PolarCell& cell) noexcept {
    constexpr float kAll = -std::numeric_limits<float>::infinity();
    const float floor_m = cell.zone == 0 ? static_cast<float>(-config_.lowest_margin * height_m_) : kAll;
    const double lowest_m =
        lowest_mean_(points.z_m, static_cast<std::size_t>(config_.lowest_points), floor_m).value_or(0.0);
    const Eigen::Vector3f origin(cell.centre_x_m, cell.centre_y_m, static_cast<float>(lowest_m));

    HalfSpace members = HalfSpace::below_height(static_cast<float>(lowest_m + config_.seed_height_m));
    PlaneFit plane;
    for (int i = 0; i < config_.iterations; ++i) {
      plane = fit_plane(statistics_inside(points, members, origin));
      if (!plane.is_valid) return plane;
      members = plane.below(config_.ground_thickness_m);
    }
    return plane;
  }

  /// GLE: upright, and near the sensor either low or flat.
  bool is_ground(const PlaneFit& plane, const PolarCell& cell) const noexcept {
    if (!plane.is_valid || plane.normal.z() < config_.min_uprightness) return false;
    const double elevation_m = plane.mean.z() + height_m_;
    if (cell.ring >= kInnerRings) return elevation_m <= config_.max_elevation_beyond_m;
    const auto ring = static_cast<std::size_t>(cell.ring);
    return elevation_m <= config_.max_elevation_m[ring] ||
           plane.surface_variation() < config_.max_surface_variation[ring];
  }

  void label(const Coordinates& returns, Sweep& sweep) const noexcept {
    const std::uint16_t* const bin_of = bins_.bin_of();
    const HalfSpace* const ground = ground_of_bin_.data();
    std::uint8_t* const mask = sweep.ground.data();
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const HalfSpace& h = ground[bin_of[i]];
      const float along =
          h.normal_x * returns.x_m[i] + h.normal_y * returns.y_m[i] + h.normal_z * returns.z_m[i];
      mask[i] = along < h.offset_m ? kGround : kNonGround;
    }
  }

  PatchworkConfig config_;
  double height_m_;
  float min_z_m_;
  Leveller level_;
  PolarBins bins_;
  LowestMean lowest_mean_;
  AlignedArray<HalfSpace> ground_of_bin_;  // one more than bins: returns outside
};

}  // namespace

std::unique_ptr<Segmenter> make_patchwork(const GroundConfig& config,
                                          const Mount& mount,
                                          std::uint32_t max_returns) {
  return std::make_unique<Patchwork>(config.patchwork, mount, max_returns);
}

}  // namespace pago::ground
