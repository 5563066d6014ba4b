// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "segment_lines.hpp"

namespace pago::ground {

/// Whether returns are near a line: the last one of their segment that holds at their range; where there is
/// none, one of the nearest segments to the left and to the right that have one, up to a bound. For nearly
/// all cells (a bin of a segment) it is the same lines for all returns, or all returns are higher than any
/// line about: that is found out once per cell.
///
/// Cells are numbered bin by bin outwards, in it segment by segment. [front thread] everything but the
/// constructor; real-time safe.
class LineLookup {
 public:
  /// [set-up] Allocates.
  explicit LineLookup(const LinefitConfig& config);

  std::size_t num_cells() const noexcept { return answers_.size() - 1; }

  /// Room for a segment's lines; how many were written is to be told.
  std::span<GroundLine> room(int segment) noexcept;
  void set_count(int segment, std::size_t count) noexcept {
    num_lines_[static_cast<std::size_t>(segment)] = count;
  }

  /// When all segments have their lines: looks into the cells for which `has_returns(cell)`.
  template <typename HasReturns>
  void prepare(const HasReturns& has_returns) noexcept {
    for (int segment = 0; segment < segments_; ++segment) cover(segment);
    for (std::size_t cell = 0; cell < num_cells(); ++cell)
      if (has_returns(cell)) answers_[cell] = answer(cell);
  }

  /// For is_near_line() of this cell, some returns later.
  void fetch(std::size_t cell) const noexcept { __builtin_prefetch(&answers_[cell]); }

  /// Of a return in this cell (num_cells(): in none).
  bool is_near_line(std::size_t cell, const RangeHeight& p) const noexcept {
    const Answer& answer = answers_[cell];
    if (!(p.z_m < answer.top_m)) return false;
    if (answer.nearest == kDepends) return search(cell, p) < limit_m_;
    return std::fabs(line(answer.nearest).above(p)) < limit_m_ ||
           std::fabs(line(answer.other).above(p)) < limit_m_;
  }

 private:
  // Numbers of lines; 0 is none, which is infinitely far from everything.
  static constexpr std::uint32_t kNone = 0, kDepends = 0xFFFFFFFFU;  // ... on the range
  static constexpr float kNowhere_m = -std::numeric_limits<float>::infinity();
  struct Answer {
    std::uint32_t nearest = kNone, other = kNone;
    float top_m = kNowhere_m;  // no return as high as this is near a line
  };
  struct Cover {
    std::uint32_t line = kNone;  // of the cell's own segment
    float top_m = kNowhere_m;    // of the segment's lines within the cell
  };

  const GroundLine& line(std::uint32_t number) const noexcept { return lines_[number]; }
  void cover(int segment) noexcept;
  Answer answer(std::size_t cell) const noexcept;
  float search(std::size_t cell, const RangeHeight& p) const noexcept;
  float distance_in(int segment, const RangeHeight& p) const noexcept;
  int wrapped(int segment) const noexcept;

  int bins_, segments_, search_;
  float limit_m_;
  double min_range_m_, bin_m_;
  std::size_t room_;  // lines per segment
  AlignedArray<GroundLine> lines_;
  AlignedArray<std::size_t> num_lines_;  // per segment
  AlignedArray<Cover> own_;              // per cell
  AlignedArray<Answer> answers_;         // per cell, and one for the returns in none
};

}  // namespace pago::ground
