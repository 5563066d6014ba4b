// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Lim, Oh and Myung, "Patchwork", RA-L 2021; parameters and their sources in config/ground/patchwork.hpp.
//
//   locate   every return's bin in the concentric zone model          (Sec. III-B)
//   group    returns of a bin side by side
//   fit      region-wise ground plane fitting, R-GPF                  (Sec. III-C)
//   judge    ground likelihood estimation: upright, low or flat       (Sec. III-D)
//   label    below the bin's plane = ground, in the sweep's own order
//
// Differs from the authors' code: normals point up, which there is left to chance (a downward one turns the
// half-space over); bins of few points are non-ground; returns are levelled by the mount first.
#include "concentric_zones.hpp"
#include "methods.hpp"
#include "plane_grower.hpp"
#include "polar_ground.hpp"

namespace pago::ground {
namespace {

constexpr int kInnerRings = 4;  // rings with a bound on elevation of their own

class Patchwork final : public Segmenter {
 public:
  Patchwork(const std::string& section,
            const PatchworkConfig& config,
            const Mount& mount,
            std::uint32_t max_returns)
      : config_(config),
        ground_(concentric_zones(
                    section, config.min_range_m, config.max_range_m, config.zone_rings, config.zone_sectors),
                mount,
                max_returns),
        grow_(growth_rule(config), max_returns) {
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override {
    height_m_ = height_m;
    min_z_m_ = static_cast<float>(-height_m - config_.low_cut_below_ground_m);
  }

  void begin(Sweep&) noexcept override { ground_.begin(); }
  void accept(const SweepPart& part) noexcept override {
    ground_.accept(part, min_z_m_, [this](int bin, const Points& points) { return judge(bin, points); });
  }
  void finish(Sweep& sweep) noexcept override {
    ground_.finish(sweep, min_z_m_, [this](int bin, const Points& points) { return judge(bin, points); });
  }

 private:
  /// R-GPF, then GLE.
  HalfSpace judge(int bin, const Points& points) noexcept {
    if (points.size() <= static_cast<std::size_t>(config_.min_points)) return HalfSpace::nothing();
    const PolarCell& cell = ground_.grid().cell(bin);
    const float floor_m =
        cell.zone == 0 ? static_cast<float>(-config_.lowest_margin * height_m_) : PlaneGrower::kNoFloor;
    const PlaneFit plane = grow_(points, floor_m, cell.centre_x_m, cell.centre_y_m);
    return is_ground(plane, cell) ? plane.below(config_.ground_thickness_m) : HalfSpace::nothing();
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

  PatchworkConfig config_;
  double height_m_ = 0.0;
  float min_z_m_ = 0.0F;
  PolarGround ground_;
  PlaneGrower grow_;
};

}  // namespace

std::unique_ptr<Segmenter> make_patchwork(const GroundConfig& config,
                                          const Mount& mount,
                                          std::uint32_t max_returns) {
  return std::make_unique<Patchwork>("ground.patchwork", config.patchwork, mount, max_returns);
}

std::unique_ptr<Segmenter> make_patchwork_hdl64(const GroundConfig& config,
                                                const Mount& mount,
                                                std::uint32_t max_returns) {
  return std::make_unique<Patchwork>("ground.patchwork_hdl64", config.patchwork_hdl64, mount, max_returns);
}

}  // namespace pago::ground
