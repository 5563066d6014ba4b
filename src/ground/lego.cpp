// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The column test of LeGO-LOAM (Shan and Englot, IROS 2018; groundRemoval in its imageProjection). It has no
// test of height, so car roofs and hedges pass. Parameters and their sources in config/ground/lego.hpp.
//
// Differs from the authors' code with the `ring` projection: vertical neighbours are returns of neighbouring
// lasers in one firing, not pixels that several beams share or none meets, and a missing neighbour does not
// undo what the pair below has said. The `uniform` projection reproduces that code, both traits included.
#include <cmath>

#include "atan2_turns.hpp"
#include "column_test.hpp"
#include "methods.hpp"
#include "pago/core/units.hpp"

namespace pago::ground {
namespace {

ColumnTest column_test(const LegoConfig& c, int rows, bool missing_undoes) {
  const double slope = std::tan(c.max_slope_deg * kDegree);
  return {.pairs = std::min(c.ground_rings, rows - 1),
          .max_slope_sq = static_cast<float>(slope * slope),
          .min_range_sq_m2 = static_cast<float>(c.min_range_m * c.min_range_m),
          .missing_undoes = missing_undoes};
}

/// On the sweep's range image. Returns that hold no cell of it are non-ground.
class RingColumnTest final : public Segmenter {
 public:
  RingColumnTest(const LegoConfig& config, const Mount& mount, std::uint32_t max_returns)
      : test_(column_test(config, kNumRings, false)), level_(mount, max_returns) {}

  void begin(Sweep&) noexcept override {
    cleared_ = 0;
    tested_ = kColumnMargin;
  }

  void accept(const SweepPart& part) noexcept override {
    clear_until(*part.sweep, part.returns_until);
    test(*part.sweep, tested_, static_cast<int>(part.columns_until));
    tested_ = std::max(tested_, static_cast<int>(part.columns_until));
  }

  /// The first columns wait for the end: lasers that look behind the encoder still fall into them.
  void finish(Sweep& sweep) noexcept override {
    const int columns = static_cast<int>(sweep.header.num_columns);
    clear_until(sweep, sweep.size);
    test(sweep, 0, std::min(kColumnMargin, columns));
    test(sweep, tested_, columns);
  }

 private:
  void clear_until(Sweep& sweep, std::uint32_t until) noexcept {
    returns_ = level_(sweep, cleared_, until);
    for (; cleared_ < until; ++cleared_) sweep.ground[cleared_] = kNonGround;
  }

  void test(Sweep& sweep, int from, int until) const noexcept {
    const IndexImage image{sweep.range_image.row(0), RangeImage::kRowStride};
    std::uint8_t* const mask = sweep.ground.data();
    test_columns(test_, returns_, image, from, until,
                 [&](int row, int column, const StripVerdict& is_ground, int width) {
                   const std::int32_t* const cells = image.at(row, column);
                   for (int k = 0; k < width; ++k)
                     if (cells[k] >= 0) mask[cells[k]] = is_ground[static_cast<std::size_t>(k)];
                 });
  }

  ColumnTest test_;
  Leveller level_;
  Coordinates returns_;
  std::uint32_t cleared_ = 0;  // returns that have a mask
  int tested_ = 0;             // columns [kColumnMargin, tested_) are done
};

/// LeGO-LOAM's grid of equal angles. Of the returns in a pixel the last one is tested, and its verdict holds
/// for all of them; returns above or below the grid, and closer ones, are non-ground.
class UniformColumnTest final : public Segmenter {
 public:
  UniformColumnTest(const LegoConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config),
        test_(column_test(config, config.uniform_rows, true)),
        level_(mount, max_returns),
        pixel_of_(max_returns),
        image_(num_pixels() + 1),
        verdict_(num_pixels() + 1) {}

  void finish(Sweep& sweep) noexcept override {
    project(sweep);
    std::fill(image_.begin(), image_.end(), RangeImage::kEmpty);
    for (std::uint32_t i = 0; i < sweep.size; ++i) image_[pixel_of_[i]] = static_cast<std::int32_t>(i);

    const Coordinates returns = level_(sweep, 0, sweep.size);
    const IndexImage image{image_.data(), config_.uniform_columns};
    test_columns(test_, returns, image, 0, config_.uniform_columns,
                 [&](int row, int column, const StripVerdict& is_ground, int width) {
                   std::copy_n(is_ground.data(), width, verdict_.data() + row * image.row_stride + column);
                 });
    for (std::uint32_t i = 0; i < sweep.size; ++i) sweep.ground[i] = verdict_[pixel_of_[i]];
  }

 private:
  std::size_t num_pixels() const noexcept {
    return static_cast<std::size_t>(config_.uniform_rows) * static_cast<std::size_t>(config_.uniform_columns);
  }

  /// Row: elevation from the bottom, cut towards zero. Column: clockwise, the x axis in the middle, rounded.
  /// Truncation and rounding as in LeGO-LOAM's projectPointCloud.
  void project(const Sweep& sweep) noexcept {
    const float rows_per_turn = static_cast<float>(360.0 / config_.uniform_row_step_deg);
    const float bottom_rows = static_cast<float>(config_.uniform_bottom_deg / config_.uniform_row_step_deg);
    const float num_rows = static_cast<float>(config_.uniform_rows);
    const std::int32_t columns = config_.uniform_columns;
    const float columns_per_turn = static_cast<float>(columns);
    const std::int32_t middle = columns / 2;
    const float middle_to_round = static_cast<float>(middle) + 0.5F;
    const float min_range_sq_m2 = test_.min_range_sq_m2;
    const auto outside = static_cast<std::int32_t>(num_pixels());
    const float* const xs = sweep.x_m.data();
    const float* const ys = sweep.y_m.data();
    const float* const zs = sweep.z_m.data();
    std::uint32_t* const pixel_of = pixel_of_.data();
    const std::uint32_t n = sweep.size;
#pragma omp simd
    for (std::uint32_t i = 0; i < n; ++i) {
      const float x = xs[i], y = ys[i], z = zs[i];
      const float range_xy_sq = x * x + y * y;
      const float range_sq = range_xy_sq + z * z;
      const bool is_usable = (range_sq >= min_range_sq_m2) & (range_sq <= std::numeric_limits<float>::max());
      const float up = atan2_turns(z, std::sqrt(range_xy_sq)) * rows_per_turn + bottom_rows;
      const float right = atan2_turns(-y, x) * columns_per_turn + middle_to_round;
      const bool is_inside = is_usable & (up > -1.0F) & (up < num_rows);
      const auto row = static_cast<std::int32_t>(is_inside ? up : 0.0F);
      // 0 to columns, which is column 0 again.
      const auto rounded = static_cast<std::int32_t>(is_inside ? right : 0.0F);
      const std::int32_t column = rounded >= columns ? rounded - columns : rounded;
      pixel_of[i] = static_cast<std::uint32_t>(is_inside ? row * columns + column : outside);
    }
  }

  LegoConfig config_;
  ColumnTest test_;
  Leveller level_;
  AlignedArray<std::uint32_t> pixel_of_;
  AlignedArray<std::int32_t> image_;    // one more than pixels: returns outside
  AlignedArray<std::uint8_t> verdict_;  // rows above the last pair and the extra one stay kNonGround
};

}  // namespace

std::unique_ptr<Segmenter> make_lego(const GroundConfig& config,
                                     const Mount& mount,
                                     std::uint32_t max_returns) {
  if (config.lego.projection == LegoConfig::Projection::kRing)
    return std::make_unique<RingColumnTest>(config.lego, mount, max_returns);
  return std::make_unique<UniformColumnTest>(config.lego, mount, max_returns);
}

}  // namespace pago::ground
