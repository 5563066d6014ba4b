// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Lee, Lim and Myung, "Patchwork++", IROS 2022; parameters and their sources in
// config/ground/patchworkpp.hpp.
//
//   locate   every return's bin in the concentric zone model, mirror images in none      (RNR)
//   fit      walls out of the first zone's bins, then the ground plane of each           (R-VPF, R-GPF)
//   judge    upright, and near the sensor low or flat, by bounds that are learnt         (A-GLE)
//   revert   elevated planes that are as flat as the others of their ring are ground     (TGR)
//   learn    the next sweep's bounds, and the height of the sensor
//
// Differs from the authors' code: what is learnt stays near the configured height, and begins there; in a
// ring with fewer than two low planes only large planes are reverted (there 0 / 0 decides); returns are
// levelled by the mount first.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "adaptive_bounds.hpp"
#include "bin_sort.hpp"
#include "concentric_zones.hpp"
#include "label.hpp"
#include "methods.hpp"
#include "pago/core/units.hpp"
#include "plane_grower.hpp"
#include "wall_removal.hpp"

namespace pago::ground {
namespace {

/// The ground plane of a bin: where it divides the bin, and what it is like.
struct Patch {
  bool is_valid = false;
  HalfSpace ground = HalfSpace::nothing();
  PlaneFit plane;  // through what lies in `ground`
  double count = 0.0, flatness_m2 = 0.0;
};

class PatchworkPlusPlus final : public Segmenter {
 public:
  PatchworkPlusPlus(const PatchworkppConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        level_(mount, max_returns),
        grid_(concentric_zones("ground.patchworkpp",
                               config.min_range_m,
                               config.max_range_m,
                               config.zone_rings,
                               config.zone_sectors)),
        bins_(grid_.num_bins(), max_returns),
        ground_(bin_count() + 1, HalfSpace::nothing()),
        walls_of_(bin_count() + 1),
        walls_(bin_count() * static_cast<std::size_t>(config.iterations)),
        candidates_(bin_count()),
        patches_(bin_count()),
        flatness_(bin_count()),
        remove_walls_({.lowest_points = config.lowest_points,
                       .seed_height_m = config.upright_seed_height_m,
                       .reach_m = config.upright_thickness_m,
                       .min_uprightness = config.min_uprightness,
                       .max_walls = config.removes_uprights ? config.iterations : 0},
                      max_returns),
        grow_(growth_rule(config), max_returns),
        mount_height_m_(mount.height_m),
        bounds_(config, mount.height_m) {}

  void set_height(double height_m) noexcept override {
    mount_height_m_ = height_m;
    reset();
  }
  void reset() noexcept override { bounds_.reset(mount_height_m_); }

  void begin(Sweep&) noexcept override { bins_.begin(); }
  void accept(const SweepPart& part) noexcept override { locate(*part.sweep, part.returns_until); }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = locate(sweep, sweep.size);
    bins_.sort_rest(returns);
    walls_.clear();
    for (int bin = 0; bin < grid_.num_bins();) bin = judge_ring(bin);
    label_by_bin(returns, bins_.bin_of(), ground_.data(), sweep);
    if (!walls_.empty()) unlabel_walls(returns, sweep);
    bounds_.learn();
  }

 private:
  struct Extent {
    std::size_t begin = 0, size = 0;
  };
  std::size_t bin_count() const noexcept { return static_cast<std::size_t>(grid_.num_bins()); }

  Coordinates locate(const Sweep& sweep, std::uint32_t until) noexcept {
    const std::uint32_t from = bins_.noted();
    const Coordinates returns = level_(sweep, from, until);
    grid_.locate(returns, from, until, -std::numeric_limits<float>::max(), bins_.bin_of());
    if (config_.removes_reflections) drop_reflections(returns, sweep.intensity.data(), from, until);
    bins_.note(until);
    return returns;
  }

  /// RNR: dark returns seen steeply below and deep under the ground.
  void drop_reflections(const Coordinates& returns,
                        const std::uint8_t* intensity,
                        std::uint32_t from,
                        std::uint32_t until) noexcept {
    const auto deepest = static_cast<float>(-bounds_.height_m() - config_.reflection_depth_m);
    const auto steepest = static_cast<float>(std::tan(config_.reflection_angle_deg * kDegree));
    const auto dark = static_cast<float>(255.0 * config_.reflection_intensity);
    const auto none = static_cast<std::uint16_t>(bin_count());
    std::uint16_t* const bin_of = bins_.bin_of();
#pragma omp simd
    for (std::uint32_t i = from; i < until; ++i) {
      const float x = returns.x_m[i], y = returns.y_m[i], z = returns.z_m[i];
      const bool is_reflection = (z < deepest) & (z < steepest * std::sqrt(x * x + y * y)) &
                                 (static_cast<float>(intensity[i]) < dark);
      bin_of[i] = is_reflection ? none : bin_of[i];
    }
  }

  /// The bins of one ring, from `first` on; returns the next ring's first bin.
  int judge_ring(int first) noexcept {
    const int ring = grid_.cell(first).ring;
    candidates_.clear();
    flatness_.clear();
    int bin = first;
    for (; bin < grid_.num_bins() && grid_.cell(bin).ring == ring; ++bin) {
      const auto b = static_cast<std::size_t>(bin);
      patches_[b] = fit(bin);
      const bool is_accepted = is_ground(patches_[b], bin);
      ground_[b] = is_accepted ? patches_[b].ground : HalfSpace::nothing();
    }
    if (config_.reverts) revert();
    return bin;
  }

  Patch fit(int bin) noexcept {
    Patch patch;
    const Points all = bins_.points(bin);
    const PolarCell& cell = grid_.cell(bin);
    auto& [walls_begin, num_walls] = walls_of_[static_cast<std::size_t>(bin)];
    walls_begin = walls_.size();
    num_walls = 0;
    if (all.size() < static_cast<std::size_t>(config_.min_points)) return patch;
    const bool is_first_zone = cell.zone == 0;
    const float floor_m = is_first_zone ? static_cast<float>(-config_.lowest_margin * bounds_.height_m())
                                        : PlaneGrower::kNoFloor;
    const float x_m = cell.centre_x_m, y_m = cell.centre_y_m;
    const Points points = is_first_zone ? remove_walls_(all, floor_m, x_m, y_m, walls_) : all;
    num_walls = walls_.size() - walls_begin;
    const PlaneFit plane = grow_(points, floor_m, x_m, y_m);
    if (!plane.is_valid) return patch;
    patch.ground = plane.below(config_.ground_thickness_m);
    const PointStatistics members = statistics_inside(points, patch.ground, plane.mean.cast<float>());
    patch.plane = fit_plane(members);
    patch.is_valid = patch.plane.is_valid;
    patch.count = members.count;
    patch.flatness_m2 = patch.plane.variance[0] * members.count / (members.count - 1.0);
    return patch;
  }

  /// A-GLE. Elevated planes of the inner rings become candidates.
  bool is_ground(const Patch& patch, int bin) noexcept {
    if (!patch.is_valid || !(patch.plane.normal.z() > config_.min_uprightness)) return false;
    const int ring = grid_.cell(bin).ring;
    if (ring >= AdaptiveBounds::kRings) return true;
    const double z_m = patch.plane.mean.z();
    const bool is_low = z_m < bounds_.max_z_m(ring);
    if (is_low) {
      bounds_.note(ring, z_m, patch.flatness_m2);
      flatness_.push_back(patch.flatness_m2);
    }
    const bool faces_sensor = patch.plane.mean.dot(patch.plane.normal) < 0.0;
    if (!faces_sensor) return false;
    if (is_low || patch.flatness_m2 < bounds_.max_flatness_m2(ring)) return true;
    candidates_.push_back(bin);
    return false;
  }

  /// TGR. The authors' logistic function of the flatness exceeds 1/2 below mean + 1.5 deviations.
  void revert() noexcept {
    const MeanDeviation ring = mean_and_deviation(flatness_.view());
    const double usual_m2 = flatness_.size() < 2 ? 0.0 : ring.mean + 1.5 * ring.deviation;
    const double thin_m2 = config_.ground_thickness_m * config_.ground_thickness_m;
    for (const int bin : candidates_) {
      const Patch& patch = patches_[static_cast<std::size_t>(bin)];
      const Eigen::Vector3d& variance = patch.plane.variance;
      const bool is_line = variance[2] > config_.max_line_ratio * variance[1];
      const bool is_large = patch.count > config_.large_points && patch.flatness_m2 < thin_m2;
      if (!is_line && (is_large || patch.flatness_m2 < usual_m2))
        ground_[static_cast<std::size_t>(bin)] = patch.ground;
    }
  }

  void unlabel_walls(const Coordinates& returns, Sweep& sweep) const noexcept {
    const std::uint16_t* const bin_of = bins_.bin_of();
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const auto [begin, size] = walls_of_[bin_of[i]];
      for (std::size_t k = begin; k < begin + size; ++k)
        if (walls_[k].holds(returns.x_m[i], returns.y_m[i], returns.z_m[i])) sweep.ground[i] = kNonGround;
    }
  }

  PatchworkppConfig config_;
  Leveller level_;
  PolarGrid grid_;
  BinSort bins_;
  AlignedArray<HalfSpace> ground_;  // per bin, and one for the returns outside
  AlignedArray<Extent> walls_of_;   // the same: in walls_
  FixedVector<Slab> walls_;
  FixedVector<int> candidates_;   // bins of the ring in hand
  AlignedArray<Patch> patches_;   // per bin
  FixedVector<double> flatness_;  // of the low planes of the ring in hand
  WallRemoval remove_walls_;
  PlaneGrower grow_;
  double mount_height_m_;
  AdaptiveBounds bounds_;
};

}  // namespace

std::unique_ptr<Segmenter> make_patchworkpp(const GroundConfig& config,
                                            const Mount& mount,
                                            std::uint32_t max_returns) {
  return std::make_unique<PatchworkPlusPlus>(config.patchworkpp, mount, max_returns);
}

}  // namespace pago::ground
