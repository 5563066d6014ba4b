// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// R-GPF: the ground of Lim, Hwang and Myung, "ERASOR", RA-L 2021, as its authors' ground benchmark runs it.
// Parameters and their sources in config/ground/rgpf.hpp. A plane per bin of a uniform polar grid, judged by
// nothing: Patchwork added that. So a bin full of wall or car becomes ground.
//
// Differs from the authors' code: normals point up, which there is left to chance; bins of few points are
// non-ground; returns are levelled by the mount first.
#include "methods.hpp"
#include "plane_grower.hpp"
#include "polar_ground.hpp"

namespace pago::ground {
namespace {

PolarGrid uniform_grid(const RgpfConfig& c) {
  return PolarGrid(std::array{PolarZone{0.0, c.rings, c.sectors}}, c.max_range_m);
}

class RegionwiseFit final : public Segmenter {
 public:
  RegionwiseFit(const RgpfConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        ground_(uniform_grid(config), mount, max_returns),
        grow_(growth_rule(config), max_returns) {
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override {
    min_z_m_ = static_cast<float>(-config_.low_cut_heights * height_m);
  }

  void begin(Sweep&) noexcept override { ground_.begin(); }
  void accept(const SweepPart& part) noexcept override {
    ground_.accept(part, min_z_m_, [this](int bin, const Points& points) { return judge(bin, points); });
  }
  void finish(Sweep& sweep) noexcept override {
    ground_.finish(sweep, min_z_m_, [this](int bin, const Points& points) { return judge(bin, points); });
  }

 private:
  HalfSpace judge(int bin, const Points& points) noexcept {
    if (points.size() <= static_cast<std::size_t>(config_.min_points)) return HalfSpace::nothing();
    const PolarCell& cell = ground_.grid().cell(bin);
    const PlaneFit plane = grow_(points, PlaneGrower::kNoFloor, cell.centre_x_m, cell.centre_y_m);
    return plane.is_valid ? plane.below(config_.ground_thickness_m) : HalfSpace::nothing();
  }

  RgpfConfig config_;
  float min_z_m_ = 0.0F;
  PolarGround ground_;
  PlaneGrower grow_;
};

}  // namespace

std::unique_ptr<Segmenter> make_rgpf(const GroundConfig& config,
                                     const Mount& mount,
                                     std::uint32_t max_returns) {
  return std::make_unique<RegionwiseFit>(config.rgpf, mount, max_returns);
}

}  // namespace pago::ground
