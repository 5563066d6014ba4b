// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Himmelsbach, v. Hundelshausen and Wuensche, "Fast segmentation of 3D point clouds for ground vehicles", IV
// 2010, with the parameters of Wellhausen's implementation; these and their sources in
// config/ground/linefit.hpp.
//
//   locate   each return's segment (sector) and bin (ring); the lowest return of each     (Sec. III-A)
//   extract  lines through a segment's lowest returns                                     (Sec. III-B)
//   label    near a line of the own segment, or else of the nearest with one = ground     (Sec. III-C)
//
// Differs from that implementation: each return is labelled, there those left over when threads divide the
// sweep are not; a line of two returns may go on over a wide gap, there it never does; returns are levelled
// by the mount first.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "line_lookup.hpp"
#include "methods.hpp"
#include "pago/core/prefetch.hpp"
#include "polar_bins.hpp"

namespace pago::ground {
namespace {

class LineFit final : public Segmenter {
 public:
  LineFit(const LinefitConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        level_(mount, max_returns),
        grid_(std::array{PolarZone{config.min_range_m, config.bins, config.segments}}, config.max_range_m),
        cell_of_(max_returns + kAhead),
        range_m_(max_returns),
        lookup_(config),
        lowest_(lookup_.num_cells() + 1),
        profile_(static_cast<std::size_t>(config.bins)) {
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override { height_m_ = height_m; }

  void begin(Sweep&) noexcept override {
    located_ = 0;
    std::fill(lowest_.begin(), lowest_.end(), RangeHeight{0.0F, kNothing});
  }
  void accept(const SweepPart& part) noexcept override { locate(*part.sweep, part.returns_until); }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = locate(sweep, sweep.size);
    for (int segment = 0; segment < config_.segments; ++segment) extract(segment);
    lookup_.prepare([this](std::size_t cell) { return lowest_[cell].z_m != kNothing; });
    std::uint8_t* const mask = sweep.ground.data();
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      lookup_.fetch(cell_of_[i + kAhead]);
      mask[i] = lookup_.is_near_line(cell_of_[i], {range_m_[i], returns.z_m[i]}) ? kGround : kNonGround;
    }
  }

 private:
  static constexpr float kNothing = std::numeric_limits<float>::infinity();
  // What a return's cell holds is fetched this many returns before: most cells are not in the nearest cache.
  static constexpr std::uint32_t kAhead = 16;

  /// Of equally low returns the first one counts.
  Coordinates locate(const Sweep& sweep, std::uint32_t until) noexcept {
    constexpr float kAnyHeight = -std::numeric_limits<float>::max();
    const Coordinates returns = level_(sweep, located_, until);
    grid_.locate(returns, located_, until, kAnyHeight, cell_of_.data());
    float* const range_m = range_m_.data();
#pragma omp simd
    for (std::uint32_t i = located_; i < until; ++i)
      range_m[i] = std::sqrt(returns.x_m[i] * returns.x_m[i] + returns.y_m[i] * returns.y_m[i]);
    for (; located_ < until; ++located_) {
      prefetch_to_write(&lowest_[cell_of_[located_ + kAhead]]);
      RangeHeight& lowest = lowest_[cell_of_[located_]];
      if (returns.z_m[located_] < lowest.z_m) lowest = {range_m[located_], returns.z_m[located_]};
    }
    return returns;
  }

  void extract(int segment) noexcept {
    std::size_t size = 0;
    const auto stride = static_cast<std::size_t>(config_.segments);
    for (std::size_t cell = static_cast<std::size_t>(segment); cell < lookup_.num_cells(); cell += stride) {
      profile_[size] = lowest_[cell];
      size += lowest_[cell].z_m < kNothing ? 1U : 0U;
    }
    lookup_.set_count(segment,
                      extract_lines(profile_.first(size), -height_m_, config_, lookup_.room(segment)));
  }

  LinefitConfig config_;
  double height_m_ = 0.0;
  Leveller level_;
  PolarGrid grid_;
  std::uint32_t located_ = 0;
  AlignedArray<std::uint16_t> cell_of_;  // per return
  AlignedArray<float> range_m_;          // per return
  LineLookup lookup_;
  AlignedArray<RangeHeight> lowest_;   // per cell, and one for the returns outside
  AlignedArray<RangeHeight> profile_;  // of the segment in hand
};

}  // namespace

std::unique_ptr<Segmenter> make_linefit(const GroundConfig& config,
                                        const Mount& mount,
                                        std::uint32_t max_returns) {
  return std::make_unique<LineFit>(config.linefit, mount, max_returns);
}

}  // namespace pago::ground
