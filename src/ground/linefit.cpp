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
// sweep are not; of two neighbours' lines the nearer one counts; returns are levelled by the mount first.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "methods.hpp"
#include "polar_bins.hpp"
#include "segment_lines.hpp"

namespace pago::ground {
namespace {

class LineFit final : public Segmenter {
 public:
  LineFit(const LinefitConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        num_segments_(config.segments),
        level_(mount, max_returns),
        grid_(std::array{PolarZone{config.min_range_m, config.bins, config.segments}}, config.max_range_m),
        cell_of_(max_returns),
        lowest_(num_cells() + 1),
        profile_(static_cast<std::size_t>(config.bins)),
        lines_(static_cast<std::size_t>(config.segments) * lines_per_segment()),
        num_lines_(static_cast<std::size_t>(config.segments)) {
    const double segment_rad = 2.0 * std::numbers::pi / config.segments;
    // k steps of a segment stay below the angle; at most half-way round.
    search_ = std::min(static_cast<int>(std::ceil(config.line_search_angle_rad / segment_rad)) - 1,
                       config.segments / 2);
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override { height_m_ = height_m; }

  void begin(Sweep&) noexcept override {
    located_ = 0;
    std::fill(lowest_.begin(), lowest_.end(), RangeHeight{0.0F, std::numeric_limits<float>::infinity()});
  }
  void accept(const SweepPart& part) noexcept override { locate(*part.sweep, part.returns_until); }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = locate(sweep, sweep.size);
    for (int segment = 0; segment < num_segments_; ++segment) extract(segment);
    for (std::uint32_t i = 0; i < sweep.size; ++i)
      sweep.ground[i] = is_ground(returns, i) ? kGround : kNonGround;
  }

 private:
  std::size_t num_cells() const noexcept { return static_cast<std::size_t>(grid_.num_bins()); }
  std::size_t lines_per_segment() const noexcept { return max_lines(static_cast<std::size_t>(config_.bins)); }

  static float range_of(const Coordinates& returns, std::uint32_t i) noexcept {
    return std::sqrt(returns.x_m[i] * returns.x_m[i] + returns.y_m[i] * returns.y_m[i]);
  }

  /// Of equally low returns the first one counts.
  Coordinates locate(const Sweep& sweep, std::uint32_t until) noexcept {
    constexpr float kAnyHeight = -std::numeric_limits<float>::max();
    const Coordinates returns = level_(sweep, located_, until);
    grid_.locate(returns, located_, until, kAnyHeight, cell_of_.data());
    for (; located_ < until; ++located_) {
      RangeHeight& lowest = lowest_[cell_of_[located_]];
      if (returns.z_m[located_] < lowest.z_m) lowest = {range_of(returns, located_), returns.z_m[located_]};
    }
    return returns;
  }

  /// Cells are numbered ring by ring.
  void extract(int segment) noexcept {
    std::size_t size = 0;
    for (std::size_t cell = static_cast<std::size_t>(segment); cell < num_cells();
         cell += static_cast<std::size_t>(num_segments_)) {
      profile_[size] = lowest_[cell];
      size += lowest_[cell].z_m < std::numeric_limits<float>::infinity() ? 1U : 0U;
    }
    const auto s = static_cast<std::size_t>(segment);
    num_lines_[s] =
        extract_lines(profile_.first(size), -height_m_, config_, {lines_of(segment), lines_per_segment()});
  }

  GroundLine* lines_of(int segment) noexcept {
    return lines_.data() + static_cast<std::size_t>(segment) * lines_per_segment();
  }

  /// Height above the last of the segment's lines that hold at this range; NaN: none does.
  float above_line(int segment, const RangeHeight& p) noexcept {
    const GroundLine* const lines = lines_of(segment);
    for (std::size_t k = num_lines_[static_cast<std::size_t>(segment)]; k-- > 0;)
      if (lines[k].holds(p.range_m)) return lines[k].above(p);
    return std::numeric_limits<float>::quiet_NaN();
  }

  bool is_ground(const Coordinates& returns, std::uint32_t i) noexcept {
    const std::size_t cell = cell_of_[i];
    if (cell == num_cells()) return false;
    const int segment = static_cast<int>(cell) % num_segments_;
    const RangeHeight p{range_of(returns, i), returns.z_m[i]};
    const auto limit = static_cast<float>(config_.max_distance_to_line_m);
    float off = std::fabs(above_line(segment, p));
    for (int k = 1; std::isnan(off) && k <= search_; ++k) {
      const int left = (segment + k) % num_segments_, right = (segment - k + num_segments_) % num_segments_;
      off = std::fmin(std::fabs(above_line(left, p)), std::fabs(above_line(right, p)));
    }
    return off < limit;
  }

  LinefitConfig config_;
  int num_segments_;
  int search_ = 0;  // segments to either side
  double height_m_ = 0.0;
  Leveller level_;
  PolarGrid grid_;
  std::uint32_t located_ = 0;
  AlignedArray<std::uint16_t> cell_of_;
  AlignedArray<RangeHeight> lowest_;   // per cell, and one for the returns outside
  AlignedArray<RangeHeight> profile_;  // of the segment in hand
  AlignedArray<GroundLine> lines_;     // lines_per_segment() places each
  AlignedArray<std::size_t> num_lines_;
};

}  // namespace

std::unique_ptr<Segmenter> make_linefit(const GroundConfig& config,
                                        const Mount& mount,
                                        std::uint32_t max_returns) {
  return std::make_unique<LineFit>(config.linefit, mount, max_returns);
}

}  // namespace pago::ground
