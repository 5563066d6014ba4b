// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground plane fitting: Zermas, Izzat and Papanikolopoulos, ICRA 2017. Parameters and their sources in
// config/ground/gpf.hpp. One plane for the sweep cannot follow a slope: the lowest returns, where it begins,
// lie far downhill.
//
// Differs from the authors' code: normals point up, which there is left to chance; returns that are zero or
// not finite are left out; returns are levelled by the mount first.
#include <array>
#include <cmath>
#include <limits>

#include "bin_sort.hpp"
#include "label.hpp"
#include "methods.hpp"
#include "plane_grower.hpp"

namespace pago::ground {
namespace {

class GroundPlaneFit final : public Segmenter {
 public:
  GroundPlaneFit(const GpfConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        ahead_x_(static_cast<float>(std::cos(mount.yaw_rad))),
        ahead_y_(static_cast<float>(-std::sin(mount.yaw_rad))),
        level_(mount, max_returns),
        sorted_(2 * kSlabs, max_returns),
        grow_(growth_rule(config), max_returns) {
    ground_.fill(HalfSpace::nothing());
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override {
    floor_m_ = static_cast<float>(-config_.low_cut_heights * height_m);
  }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = level_(sweep, 0, sweep.size);
    sort(returns, sweep.size);
    for (int slab = 0; slab < kSlabs; ++slab) {
      const auto bin = static_cast<std::size_t>(2 * slab);
      ground_[bin] = ground_[bin + 1] = ground_in(slab);
    }
    label_by_bin(returns, sorted_.bin_of(), ground_.data(), sweep);
  }

 private:
  static constexpr int kSlabs = 3;  // behind, beside, ahead; one plane: all beside

  /// Two bins per slab: what may start the plane, and what is too low for that.
  void sort(const Coordinates& returns, std::uint32_t size) noexcept {
    constexpr float kMaxFinite = std::numeric_limits<float>::max();
    const bool has_slabs = config_.planes == GpfConfig::Planes::kSlabs;
    const float slab_m = has_slabs ? static_cast<float>(config_.slab_m) : kMaxFinite;
    const float ahead_x = ahead_x_, ahead_y = ahead_y_, floor_m = floor_m_;
    sorted_.begin();
    std::uint16_t* const bin_of = sorted_.bin_of();
#pragma omp simd
    for (std::uint32_t i = 0; i < size; ++i) {
      const float x = returns.x_m[i], y = returns.y_m[i], z = returns.z_m[i];
      const float ahead_m = ahead_x * x + ahead_y * y;
      const std::int32_t slab = 1 + (ahead_m > slab_m) - (ahead_m < -slab_m);
      const std::int32_t bin = 2 * slab + (z < floor_m);
      bin_of[i] = static_cast<std::uint16_t>(is_return(x, y, z) ? bin : 2 * kSlabs);
    }
    sorted_.note(size);
    sorted_.sort_rest(returns);
  }

  HalfSpace ground_in(int slab) noexcept {
    const Points starters = sorted_.points(2 * slab), all = sorted_.points(2 * slab, 2 * slab + 2);
    const PlaneFit plane = grow_(starters, all, PlaneGrower::kNoFloor, 0.0F, 0.0F);
    return plane.is_valid ? plane.below(config_.ground_thickness_m) : HalfSpace::nothing();
  }

  GpfConfig config_;
  float ahead_x_, ahead_y_;  // the vehicle's x axis in levelled coordinates
  float floor_m_ = 0.0F;
  Leveller level_;
  BinSort sorted_;
  std::array<HalfSpace, 2 * kSlabs + 1> ground_;  // per bin, and nothing for the returns in none
  PlaneGrower grow_;
};

}  // namespace

std::unique_ptr<Segmenter> make_gpf(const GroundConfig& config,
                                    const Mount& mount,
                                    std::uint32_t max_returns) {
  return std::make_unique<GroundPlaneFit>(config.gpf, mount, max_returns);
}

}  // namespace pago::ground
