// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segment_lines.hpp"

#include <algorithm>
#include <cmath>

namespace pago::ground {
namespace {

struct Line {
  double slope = 0.0, base_m = 0.0;
  double at(const RangeHeight& p) const noexcept { return slope * static_cast<double>(p.range_m) + base_m; }
};

/// What a least-squares line through some points needs of them. Sums, so that a point more costs nothing.
class LineSums {
 public:
  void add(const RangeHeight& p) noexcept {
    const double d = static_cast<double>(p.range_m), z = static_cast<double>(p.z_m);
    n_ += 1.0;
    d_ += d;
    z_ += z;
    dd_ += d * d;
    dz_ += d * z;
  }
  Line fit() const noexcept {
    const double slope = (n_ * dz_ - d_ * z_) / (n_ * dd_ - d_ * d_);
    return {slope, (z_ - slope * d_) / n_};
  }

 private:
  double n_ = 0.0, d_ = 0.0, z_ = 0.0, dd_ = 0.0, dz_ = 0.0;
};

/// The points [first, end) that the line in the making runs through, and the line.
class Run {
 public:
  Run(std::span<const RangeHeight> points, const LinefitConfig& config) : points_(points), config_(config) {
    restart(0);
  }

  std::size_t size() const noexcept { return end_ - first_; }
  const RangeHeight& back() const noexcept { return points_[end_ - 1]; }
  const Line& line() const noexcept { return line_; }

  void restart(std::size_t at) noexcept {
    first_ = at;
    end_ = at + 1;
    sums_ = {};
    sums_.add(points_[at]);
  }

  /// Takes the next point without a look at the line.
  void take() noexcept { sums_.add(points_[end_++]); }

  /// Takes the next point, if the line through all is good.
  bool take_if_good(bool is_long) noexcept {
    const RangeHeight& next = points_[end_];
    LineSums sums = sums_;
    sums.add(next);
    const Line line = sums.fit();
    const bool is_foretold = is_long && size() > 2;
    const bool is_surprise =
        is_foretold && std::abs(line_.at(next) - static_cast<double>(next.z_m)) > config_.max_long_step_m;
    if (is_surprise || !is_good(line, end_ + 1)) return false;
    sums_ = sums;
    line_ = line;
    ++end_;
    return true;
  }

  GroundLine ground() const noexcept {
    return {static_cast<float>(line_.slope), static_cast<float>(line_.base_m),
            static_cast<float>(static_cast<double>(points_[first_].range_m) - config_.line_reach_m),
            static_cast<float>(static_cast<double>(back().range_m) + config_.line_reach_m)};
  }

 private:
  bool is_good(const Line& line, std::size_t end) const noexcept {
    const double slope = std::abs(line.slope);
    const bool is_steep = !(slope <= config_.max_slope);  // or not finite: two returns at one range
    if (is_steep || (end - first_ > 2 && slope < config_.min_slope)) return false;
    double worst = 0.0;
    for (std::size_t i = first_; i < end; ++i)
      worst = std::max(worst, std::abs(line.at(points_[i]) - static_cast<double>(points_[i].z_m)));
    return worst <= config_.max_fit_error_m;
  }

  std::span<const RangeHeight> points_;
  const LinefitConfig& config_;
  std::size_t first_ = 0, end_ = 1;
  LineSums sums_;
  Line line_;  // of three points and more
};

}  // namespace

std::size_t extract_lines(std::span<const RangeHeight> points,
                          double ground_z_m,
                          const LinefitConfig& config,
                          std::span<GroundLine> lines) noexcept {
  if (points.empty()) return 0;
  std::size_t num_lines = 0;
  Run run(points, config);
  bool is_long = false;
  for (std::size_t next = 1; next < points.size(); ++next) {
    const double gap_m = static_cast<double>(points[next].range_m) - static_cast<double>(run.back().range_m);
    is_long = is_long || gap_m > config.long_gap_m;
    if (run.size() >= 2) {
      if (run.take_if_good(is_long)) continue;
      if (run.size() >= 3) {
        lines[num_lines++] = run.ground();
        ground_z_m = run.line().at(run.back());
      }
      is_long = false;
      run.restart(next - 1);
    }
    // One point: does a line begin here? (A line that has just ended takes its long gap along.)
    is_long = is_long || gap_m > config.long_gap_m;
    const double step_m = std::abs(static_cast<double>(run.back().z_m) - ground_z_m);
    if (gap_m < config.long_gap_m && step_m < config.max_start_step_m) {
      run.take();
    } else {
      run.restart(next);
    }
  }
  if (run.size() > 2) lines[num_lines++] = run.ground();
  return num_lines;
}

}  // namespace pago::ground
